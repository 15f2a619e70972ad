//! Configurations whose parts are known when a program runs.
//!
//! A compiled kernel has its parts in its type: `(Isometry3, SVector<2>)`. Here they are data: which groups come first,
//! two bits each, in every vector that depends on them. All functions of a part are those of its group's own type.

use core::ops::Range;

use gauss_codegen::description::{Description, QuantityKind};
use gauss_runtime::prelude::{Configuration, Isometry2, Isometry3, SVector, UnitQuaternion, VectorSpace};

/// Groups at the beginning of a configuration, in their order; what follows are plain coordinates. Vectors that were
/// made without a configuration do not know theirs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Groups(u64);

/// A part of a configuration.
#[derive(Clone, Copy)]
enum Part {
    /// A unit quaternion x, y, z, w; increments are rotations in the body's frame.
    Rotation,
    /// The rotation of a body, then its position; increments are twists × time, pole O, body frame.
    Pose,
    /// Cosine and sine, then the position in the plane.
    Plane,
    Coordinate,
}

/// Largest number of groups of a configuration.
pub const MOST_GROUPS: usize = 31;

/// Behind two bits for each group.
const KNOWN: u64 = 1 << 63;

/// Calls a function of the type of a part.
macro_rules! of_part {
    ($part:expr, $function:ident($($argument:expr),*)) => {
        match $part {
            Part::Rotation => $function::<UnitQuaternion<f64>>($($argument),*),
            Part::Pose => $function::<Isometry3<f64>>($($argument),*),
            Part::Plane => $function::<Isometry2<f64>>($($argument),*),
            Part::Coordinate => $function::<SVector<f64, 1>>($($argument),*),
        }
    };
}

impl Groups {
    /// The groups of a scene; none where they are more than [`MOST_GROUPS`].
    pub fn of(description: &Description) -> Option<Self> {
        let codes = description.coordinates.iter().filter_map(|part| match part.kind {
            QuantityKind::Rotation => Some(1),
            QuantityKind::Pose => Some(2),
            QuantityKind::Plane => Some(3),
            QuantityKind::Scalar | QuantityKind::Vector(_) => None,
        });
        let codes: Vec<u64> = codes.collect();
        let all = codes.iter().take(MOST_GROUPS).rev().fold(0, |all, code| all << 2 | code);
        (codes.len() <= MOST_GROUPS).then_some(Self(all | KNOWN))
    }

    /// Plain coordinates alone.
    const NONE: Self = Self(KNOWN);

    fn is_known(self) -> bool {
        self.0 & KNOWN != 0
    }

    /// Groups of the one of two vectors that knows them.
    fn or(self, other: Self) -> Self {
        if self.is_known() { self } else { other }
    }

    /// Every part with the places of its components and of its increments, within vectors of so many numbers: behind
    /// the groups each number is a coordinate.
    fn parts(self, length: usize) -> impl Iterator<Item = (Part, Range<usize>, Range<usize>)> {
        let (mut rest, mut component, mut increment) = (self.0 & !KNOWN, 0, 0);
        core::iter::from_fn(move || {
            let (part, components, increments) = match rest & 3 {
                0 => (Part::Coordinate, 1, 1),
                1 => (Part::Rotation, 4, 3),
                2 => (Part::Pose, 7, 6),
                _ => (Part::Plane, 4, 3),
            };
            let places = (component..component + components, increment..increment + increments);
            (rest, component, increment) = (rest >> 2, places.0.end, places.1.end);
            (places.0.end <= length).then_some((part, places.0, places.1))
        })
    }

    /// Writes a vector part by part: of a configuration with so many components.
    fn write_parts(self, length: usize, to: &mut [f64], each: impl Fn(&mut [f64], Part, Range<usize>, Range<usize>)) {
        self.parts(length).for_each(|(part, components, increments)| each(to, part, components, increments));
    }

    /// `q ∘ exp(increment)`, at norm 1.
    pub(crate) fn retract(self, q: &[f64], by: &[f64], to: &mut [f64]) {
        self.write_parts(q.len(), to, |to, part, c, i| of_part!(part, advance(&mut to[c.clone()], &q[c], &by[i])));
    }

    /// `log(q⁻¹ ∘ other)`.
    pub(crate) fn difference(self, q: &[f64], other: &[f64], to: &mut [f64]) {
        let each =
            |to: &mut [f64], part, c: Range<usize>, i| of_part!(part, difference(&mut to[i], &q[c.clone()], &other[c]));
        self.write_parts(q.len(), to, each);
    }

    /// The increment that changes the components by so much, to first order.
    pub(crate) fn tangent(self, q: &[f64], change: &[f64], to: &mut [f64]) {
        let each =
            |to: &mut [f64], part, c: Range<usize>, i| of_part!(part, tangent(&mut to[i], &q[c.clone()], &change[c]));
        self.write_parts(q.len(), to, each);
    }

    /// Rates of the components at a velocity seen from the body.
    pub(crate) fn component_rates(self, q: &[f64], velocity: &[f64], to: &mut [f64]) {
        let each = |to: &mut [f64], part, c: Range<usize>, i| {
            of_part!(part, component_rates(&mut to[c.clone()], &q[c], &velocity[i]))
        };
        self.write_parts(q.len(), to, each);
    }
}

/// A vector of at most N numbers: components of a configuration with such groups, or one of its increments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MixedVector<const N: usize> {
    list: SVector<f64, N>,
    groups: Groups,
}

impl<const N: usize> MixedVector<N> {
    pub(crate) fn new(list: SVector<f64, N>, groups: Groups) -> Self {
        Self { list, groups }
    }

    /// All N numbers; those that the model does not have are zero.
    pub fn as_slice(&self) -> &[f64] {
        self.list.as_slice()
    }
}

impl<const N: usize> VectorSpace<f64> for MixedVector<N> {
    const DIM: usize = N;

    #[inline]
    fn zero() -> Self {
        Self { list: SVector::zeros(), groups: Groups::default() }
    }

    #[inline]
    fn add_scaled(&self, a: f64, x: &Self) -> Self {
        Self { list: self.list.add_scaled(a, &x.list), groups: self.groups.or(x.groups) }
    }

    #[inline]
    fn scale(&self, a: f64) -> Self {
        Self { list: VectorSpace::scale(&self.list, a), groups: self.groups }
    }

    #[inline]
    fn component(&self, i: usize) -> f64 {
        self.list[i]
    }

    #[inline]
    fn set_component(&mut self, i: usize, value: f64) {
        self.list[i] = value;
    }
}

/// A configuration of at most N components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MixedConfiguration<const N: usize> {
    list: SVector<f64, N>,
    groups: Groups,
}

impl<const N: usize> MixedConfiguration<N> {
    pub(crate) fn new(list: SVector<f64, N>, groups: Groups) -> Self {
        Self { list, groups }
    }

    /// All N components; those that the model does not have are zero.
    pub fn as_slice(&self) -> &[f64] {
        self.list.as_slice()
    }
}

/// Plain coordinates.
impl<const N: usize> From<SVector<f64, N>> for MixedConfiguration<N> {
    fn from(list: SVector<f64, N>) -> Self {
        Self { list, groups: Groups::NONE }
    }
}

fn vector<V: VectorSpace<f64>>(numbers: &[f64]) -> V {
    let mut vector = V::zero();
    (0..V::DIM).for_each(|i| vector.set_component(i, numbers[i]));
    vector
}

fn put<V: VectorSpace<f64>>(to: &mut [f64], vector: &V) {
    (0..V::DIM).for_each(|i| to[i] = vector.component(i));
}

fn place<Q: Configuration<Scalar = f64>>(numbers: &[f64]) -> Q {
    Q::from_components(&vector(numbers))
}

fn retract<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64], tangent: &[f64]) {
    put(to, &place::<Q>(q).retract(&vector(tangent)).components());
}

fn advance<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64], tangent: &[f64]) {
    put(to, &place::<Q>(q).advance(&vector(tangent)).components());
}

fn retract_carrying<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64], tangent: &[f64], carried: &mut [f64]) {
    let mut low = vector(carried);
    put(to, &place::<Q>(q).retract_carrying(&vector(tangent), &mut low).components());
    put(carried, &low);
}

fn difference<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64], other: &[f64]) {
    put(to, &place::<Q>(q).difference(&place(other)));
}

fn dexp_inv<Q: Configuration<Scalar = f64>>(to: &mut [f64], v: &[f64], w: &[f64]) {
    put(to, &Q::dexp_inv(&vector(v), &vector(w)));
}

fn bracket<Q: Configuration<Scalar = f64>>(to: &mut [f64], v: &[f64], w: &[f64]) {
    put(to, &Q::bracket(&vector(v), &vector(w)));
}

fn dexp<Q: Configuration<Scalar = f64>>(to: &mut [f64], v: &[f64], w: &[f64]) {
    put(to, &Q::dexp(&vector(v))(&vector(w)));
}

fn component_rates<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64], velocity: &[f64]) {
    put(to, &place::<Q>(q).component_rates(&vector(velocity)));
}

fn tangent<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64], change: &[f64]) {
    put(to, &place::<Q>(q).tangent(&vector(change)));
}

fn norm_correction<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64]) {
    put(to, &place::<Q>(q).norm_correction());
}

fn renormalise<Q: Configuration<Scalar = f64>>(to: &mut [f64], q: &[f64]) {
    put(to, &place::<Q>(q).renormalise().components());
}

fn increment_angle<Q: Configuration<Scalar = f64>>(tangent: &[f64]) -> f64 {
    Q::increment_angle(&vector(tangent))
}

fn magnitude<Q: Configuration<Scalar = f64>>(q: &[f64], i: usize) -> f64 {
    place::<Q>(q).magnitude(i)
}

impl<const N: usize> MixedConfiguration<N> {
    fn parts(&self) -> impl Iterator<Item = (Part, Range<usize>, Range<usize>)> {
        self.groups.parts(N)
    }

    /// A vector that depends on this configuration, part by part.
    fn vector(&self, each: impl Fn(&mut [f64], Part, Range<usize>, Range<usize>)) -> SVector<f64, N> {
        by_parts(self.groups, each)
    }
}

/// A vector, part by part.
fn by_parts<const N: usize>(
    groups: Groups,
    each: impl Fn(&mut [f64], Part, Range<usize>, Range<usize>),
) -> SVector<f64, N> {
    let mut vector = SVector::<f64, N>::zeros();
    groups
        .parts(N)
        .for_each(|(part, components, increments)| each(vector.as_mut_slice(), part, components, increments));
    vector
}

/// Two increments, part by part.
fn of_increments<const N: usize>(
    v: &MixedVector<N>,
    w: &MixedVector<N>,
    each: impl Fn(Part, &mut [f64], &[f64], &[f64]),
) -> MixedVector<N> {
    let groups = v.groups.or(w.groups);
    let is_zero = |vector: &MixedVector<N>| vector.list.iter().all(|x| *x == 0.0);
    if !(groups.is_known() || is_zero(v) || is_zero(w)) {
        // Of what groups they are cannot be told: no number is right.
        return MixedVector { list: SVector::repeat(f64::NAN), groups };
    }
    let list = by_parts(groups, |all, part, _, own| {
        each(part, &mut all[own.clone()], &v.as_slice()[own.clone()], &w.as_slice()[own])
    });
    MixedVector { list, groups }
}

impl<const N: usize> Configuration for MixedConfiguration<N> {
    type Scalar = f64;
    type Tangent = MixedVector<N>;
    type Components = MixedVector<N>;

    fn retract(&self, by: &MixedVector<N>) -> Self {
        let (q, by) = (self.as_slice(), by.as_slice());
        let list = self.vector(|to, part, c, i| of_part!(part, retract(&mut to[c.clone()], &q[c], &by[i])));
        Self { list, ..*self }
    }

    fn advance(&self, by: &MixedVector<N>) -> Self {
        let (q, by) = (self.as_slice(), by.as_slice());
        let list = self.vector(|to, part, c, i| of_part!(part, advance(&mut to[c.clone()], &q[c], &by[i])));
        Self { list, ..*self }
    }

    fn retract_carrying(&self, by: &MixedVector<N>, carried: &mut MixedVector<N>) -> Self {
        let (q, by, low) = (self.as_slice(), by.as_slice(), carried.list.as_mut_slice());
        let mut list = SVector::<f64, N>::zeros();
        for (part, c, i) in self.parts() {
            let to = &mut list.as_mut_slice()[c.clone()];
            of_part!(part, retract_carrying(to, &q[c], &by[i.clone()], &mut low[i]));
        }
        Self { list, ..*self }
    }

    fn difference(&self, other: &Self) -> MixedVector<N> {
        let groups = self.groups.or(other.groups);
        let (q, other) = (self.as_slice(), other.as_slice());
        let list = by_parts(groups, |to, part, c, i| of_part!(part, difference(&mut to[i], &q[c.clone()], &other[c])));
        MixedVector { list, groups }
    }

    fn dexp_inv(v: &MixedVector<N>, w: &MixedVector<N>) -> MixedVector<N> {
        of_increments(v, w, |part, to, v, w| of_part!(part, dexp_inv(to, v, w)))
    }

    fn bracket(v: &MixedVector<N>, w: &MixedVector<N>) -> MixedVector<N> {
        of_increments(v, w, |part, to, v, w| of_part!(part, bracket(to, v, w)))
    }

    fn dexp(v: &MixedVector<N>) -> impl Fn(&MixedVector<N>) -> MixedVector<N> {
        let v = *v;
        move |w| of_increments(&v, w, |part, to, v, w| of_part!(part, dexp(to, v, w)))
    }

    fn components(&self) -> MixedVector<N> {
        MixedVector { list: self.list, groups: self.groups }
    }

    fn from_components(components: &MixedVector<N>) -> Self {
        Self { list: components.list, groups: components.groups }
    }

    fn component_rates(&self, velocity: &MixedVector<N>) -> MixedVector<N> {
        let (q, velocity) = (self.as_slice(), velocity.as_slice());
        let list =
            self.vector(|to, part, c, i| of_part!(part, component_rates(&mut to[c.clone()], &q[c], &velocity[i])));
        MixedVector { list, groups: self.groups }
    }

    fn tangent(&self, change: &MixedVector<N>) -> MixedVector<N> {
        let (q, change) = (self.as_slice(), change.as_slice());
        let list = self.vector(|to, part, c, i| of_part!(part, tangent(&mut to[i], &q[c.clone()], &change[c])));
        MixedVector { list, groups: self.groups }
    }

    fn is_finite(&self) -> bool {
        VectorSpace::is_finite(&self.list)
    }

    fn norm_correction(&self) -> MixedVector<N> {
        let q = self.as_slice();
        let list = self.vector(|to, part, c, _| of_part!(part, norm_correction(&mut to[c.clone()], &q[c])));
        MixedVector { list, groups: self.groups }
    }

    fn renormalise(&self) -> Self {
        let q = self.as_slice();
        let list = self.vector(|to, part, c, _| of_part!(part, renormalise(&mut to[c.clone()], &q[c])));
        Self { list, ..*self }
    }

    fn increment_angle(by: &MixedVector<N>) -> f64 {
        let angles = by.groups.parts(N).map(|(part, _, i)| of_part!(part, increment_angle(&by.as_slice()[i])));
        angles.fold(0.0, f64::max)
    }

    fn magnitude(&self, i: usize) -> f64 {
        let (mut component, mut increment) = (0, 0);
        for (part, c, own) in self.parts().take_while(|(part, ..)| !matches!(part, Part::Coordinate)) {
            if own.contains(&i) {
                return of_part!(part, magnitude(&self.as_slice()[c], i - own.start));
            }
            (component, increment) = (c.end, own.end);
        }
        // Coordinates, behind which there are no numbers.
        self.as_slice().get(component + i - increment).map_or(0.0, |x| x.abs())
    }
}
