//! Random scenes: what a run decides and the forces it has, against the laws with A, W and accelerations formed anew.
//!
//! A is `mass_matrix`, W is `contact_jacobian`, b is the rate of `contact_rates` along the motion by dual numbers; its
//! own D and b no test here asks a kernel for. Units of length, mass and time are from 10⁻⁶ to 10⁶, numbers in these
//! units from 0.1 to 10.

use gauss_contact::{ContactRun, EventKind, Impact};
use gauss_runtime::contact::ContactSystem;
use gauss_runtime::prelude::*;

use crate::dual::Dual;

/// A mass on two legs with feet on steps of their own, and a hinge between the legs that rubs.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z, a, b),
    particle(mass = m, position = [x, 0, z]),
    particle(mass = m1, position = [x + l1 * sin(a), 0, z - l1 * cos(a)]),
    particle(mass = m2, position = [x + l2 * sin(b), 0, z - l2 * cos(b)]),
    drive(x = push, a = torque1, b = torque2),
    contact(left, gap = z - l1 * cos(a) - h1, slip = rate(x + l1 * sin(a)), friction = mu1, restitution = e),
    contact(right, gap = z - l2 * cos(b) - h2, slip = rate(x + l2 * sin(b)), friction = mu2, restitution = e),
    dry_friction(hinge, slip = rate(a - b), bound = f),
)]
#[derive(Clone, Copy, Debug)]
struct Walker<T> {
    m: T,
    m1: T,
    m2: T,
    l1: T,
    l2: T,
    h1: T,
    h2: T,
    mu1: T,
    mu2: T,
    e: T,
    f: T,
    push: T,
    torque1: T,
    torque2: T,
    #[gauss(gravity)]
    g: T,
}

impl Walker<f64> {
    fn dual(self) -> Walker<Dual<f64>> {
        let of = |x: f64| Dual::new(x, 0.0);
        Walker {
            m: of(self.m),
            m1: of(self.m1),
            m2: of(self.m2),
            l1: of(self.l1),
            l2: of(self.l2),
            h1: of(self.h1),
            h2: of(self.h2),
            mu1: of(self.mu1),
            mu2: of(self.mu2),
            e: of(self.e),
            f: of(self.f),
            push: of(self.push),
            torque1: of(self.torque1),
            torque2: of(self.torque2),
            g: of(self.g),
        }
    }
}

/// A box on its four lower corners, its centre of mass anywhere in it: 12 rows for six speeds.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(pose: Pose),
    body(cargo, position = pose.position, rotation = pose.rotation),
    contact(floor, point = cargo.position, edges = [a, b, c], friction = mu, restitution = e),
)]
struct Crate {
    #[gauss(body)]
    cargo: RigidBody<f64>,
    #[gauss(gravity)]
    g: Vector3<f64>,
    a: f64,
    b: f64,
    c: f64,
    mu: f64,
    e: f64,
}

/// Numbers in (0, 1): a linear congruence with the constants of Knuth's MMIX.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
    }

    fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }

    /// From 0.1 to 10.
    fn positive(&mut self) -> f64 {
        10.0_f64.powf(self.signed())
    }

    /// Either way.
    fn any(&mut self) -> f64 {
        self.positive() * self.signed().signum()
    }

    fn unit(&mut self) -> f64 {
        10.0_f64.powf(6.0 * self.signed())
    }
}

/// What contacts did.
#[derive(Debug, Default)]
struct Seen {
    leave: usize,
    stick: usize,
    slide: usize,
}

/// The laws of Signorini and Coulomb between forces and rates, or impulses and velocities, as they are written.
///
/// `bounds`: μ of each contact, f of dry friction. `slips`: before, of what slides already. Rates are held to 10⁻⁹ of
/// the terms that they are sums of: some roundings times the condition of A and of D, below 10⁶ by numbers from 0.1 to
/// 10.
struct Laws<'a, const R: usize> {
    matrix: SMatrix<f64, R, R>,
    forces: SVector<f64, R>,
    rates: SVector<f64, R>,
    friction: SVector<f64, R>,
    slips: Option<&'a SVector<f64, R>>,
}

const LITTLE: f64 = 1e-9;

impl<const R: usize> Laws<'_, R> {
    /// The terms of a row, in units of its force.
    fn size(&self, row: usize) -> f64 {
        let terms = |row: usize| -> f64 {
            (0..R).map(|j| (self.matrix[(row, j)] * self.forces[j]).abs()).sum::<f64>() + self.rates[row].abs()
        };
        terms(row) / self.matrix[(row, row)]
    }

    #[track_caller]
    fn hold(&self, contact: &gauss_runtime::contact::Contact, closed: bool, seen: &mut Seen) {
        let forces = |row: usize| self.forces[row];
        if !closed {
            assert!(contact.rows().all(|row| forces(row) == 0.0), "{contact} is open");
            return;
        }
        let mut pressed = 1.0;
        if contact.has_gap() {
            let row = contact.normal;
            let (force, rate) = (forces(row), self.rates[row] / self.matrix[(row, row)]);
            let little = LITTLE * self.size(row);
            assert!(force >= -little && rate >= -little && force.min(rate) <= little, "{contact} {force:e} {rate:e}");
            pressed = force.max(0.0);
            seen.leave += usize::from(rate > little);
        }
        let tangents: Vec<usize> = contact.tangent_rows().collect();
        let Some(&first) = tangents.first() else { return };
        let norm = |of: &dyn Fn(usize) -> f64| tangents.iter().map(|&row| of(row).powi(2)).sum::<f64>().sqrt();
        let bound = pressed * self.friction[first];
        let scale = tangents.iter().map(|&row| self.matrix[(row, row)]).fold(0.0, f64::max);
        let little = LITTLE * tangents.iter().map(|&row| self.size(row)).fold(bound, f64::max);
        assert!(norm(&forces) <= bound + little, "{contact} {:e} beyond {bound:e}", norm(&forces));
        let (slip, known) = match self.slips.filter(|slips| norm(&|row| slips[row]) > 0.0) {
            Some(slips) => (slips, true),
            None => (&self.rates, false),
        };
        let size = norm(&|row| slip[row]);
        let slides = known || size / scale > little;
        if slides {
            // Forces that end in the direction of the slip are off by what is little of it.
            let off = if known { 0.0 } else { bound * little * scale / size };
            let miss = norm(&|row| forces(row) + bound * slip[row] / size);
            assert!(miss <= little + off, "{contact} {miss:e} {little:e} {off:e}");
        }
        if pressed > 0.0 {
            *(if slides { &mut seen.slide } else { &mut seen.stick }) += 1;
        }
    }
}

/// D from the mass matrix, for a kernel whose W and A are matrices.
fn delassus<const N: usize, const R: usize>(
    a: SMatrix<f64, N, N>,
    w: &SMatrix<f64, N, R>,
) -> (SMatrix<f64, N, R>, SMatrix<f64, R, R>) {
    // Scaled to a diagonal of 1: units are far apart.
    let scale = SVector::<f64, N>::from_fn(|i, _| 1.0 / a[(i, i)].sqrt());
    let scaled = SMatrix::<f64, N, N>::from_fn(|i, j| a[(i, j)] * scale[i] * scale[j]);
    let right = SMatrix::<f64, N, R>::from_fn(|i, j| w[(i, j)] * scale[i]);
    let solved = scaled.cholesky().expect("A is positive definite").solve(&right);
    let columns = SMatrix::<f64, N, R>::from_fn(|i, j| solved[(i, j)] * scale[i]);
    (columns, w.transpose() * columns)
}

/// Parameters of a walker that stands on both feet at these angles, and the units of mass, length and time.
fn walker(numbers: &mut Numbers) -> (Walker<f64>, SVector<f64, 4>, [f64; 3]) {
    let units @ [mass, length, time] = [numbers.unit(), numbers.unit(), numbers.unit()];
    let force = mass * length / (time * time);
    let (l1, l2) = (length * numbers.positive(), length * numbers.positive());
    let q =
        SVector::from([length * numbers.any(), length * numbers.any(), 1.4 * numbers.signed(), 1.4 * numbers.signed()]);
    let walker = Walker {
        m: mass * numbers.positive(),
        m1: mass * numbers.positive(),
        m2: mass * numbers.positive(),
        l1,
        l2,
        h1: q[1] - l1 * q[2].cos(),
        h2: q[1] - l2 * q[3].cos(),
        mu1: 0.6 * numbers.next(),
        mu2: 0.6 * numbers.next(),
        e: numbers.next(),
        f: force * length * numbers.positive(),
        push: force * numbers.any(),
        torque1: force * length * numbers.any(),
        torque2: force * length * numbers.any(),
        g: length / (time * time) * numbers.positive(),
    };
    (walker, q, units)
}

#[test]
fn walkers_of_random_numbers_stand_slide_and_lift_their_feet_by_the_laws() {
    let (mut numbers, mut seen) = (Numbers(3), Seen::default());
    for n in 0..200 {
        let (walker, q, [_, length, time]) = walker(&mut numbers);
        let (kernel, dual) = (walker.kernel().unwrap(), walker.dual().kernel().unwrap());
        // From rest, or in motion along both steps.
        let mut z = SVector::zeros();
        if n % 2 == 1 {
            let along = numbers.any() / time;
            let up = -walker.l1 * q[2].sin() * along;
            z = SVector::from([length * numbers.any() / time, up, along, -up / (walker.l2 * q[3].sin())]);
        }
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..1e-9 * time).unwrap();
        let forces = *run.forces(0.0).unwrap();
        let w = kernel.contact_jacobian(0.0, &q);
        let (columns, matrix) = delassus(kernel.mass_matrix(0.0, &q), &w);
        let acceleration = kernel.acceleration(0.0, &q, &z, &()) + columns * forces;
        let along = q.zip_map(&z, Dual::new);
        let rates = dual.contact_rates(Dual::new(0.0, 1.0), &along, &z.zip_map(&acceleration, Dual::new));
        let slips = kernel.contact_rates(0.0, &q, &z);
        let laws = Laws {
            matrix,
            forces,
            rates: rates.map(|rate| rate.rate),
            friction: kernel.friction(0.0, &q, &z, &()),
            slips: (n % 2 == 1).then_some(&slips),
        };
        for contact in WalkerKernel::<f64>::CONTACTS {
            laws.hold(contact, true, &mut seen);
        }
    }
    assert!(seen.leave > 40 && seen.stick > 100 && seen.slide > 100, "{seen:?}");
}

#[test]
fn feet_of_random_walkers_strike_by_the_laws_of_impact() {
    let (mut numbers, mut seen) = (Numbers(5), Seen::default());
    for n in 0..100 {
        let (walker, q, [_, length, time]) = walker(&mut numbers);
        let kernel = walker.kernel().unwrap();
        let speeds = [length * numbers.any(), -length * numbers.positive(), numbers.any(), numbers.any()];
        let z = SVector::from(speeds) / time;
        let law = if n % 2 == 0 { Impact::Newton } else { Impact::Moreau };
        let (run, _) = ContactRun::new(&kernel).law(law).adaptive(1e-9, 1e-9).attempt(q, z, 0.0..1e-9 * time);
        let mut forces = SVector::zeros();
        for event in run.events().iter().filter(|event| event.time == 0.0) {
            if let EventKind::Impact(record) = event.kind {
                let rows = WalkerKernel::<f64>::CONTACTS[event.contact].rows();
                rows.zip(record.impulse).for_each(|(row, impulse)| forces[row] += impulse);
            }
        }
        let (_, matrix) = delassus(kernel.mass_matrix(0.0, &q), &kernel.contact_jacobian(0.0, &q));
        let before = kernel.contact_rates(0.0, &q, &z);
        let after = before + matrix * forces;
        let e = walker.e;
        let rates = if law == Impact::Moreau { (after + before * e) / (1.0 + e) } else { after };
        let restored = SVector::<f64, 5>::from([e, 0.0, e, 0.0, 0.0]).component_mul(&before);
        let rates = if law == Impact::Moreau { rates } else { rates + restored };
        let laws = Laws { matrix, forces, rates, friction: kernel.friction(0.0, &q, &z, &()), slips: None };
        for contact in WalkerKernel::<f64>::CONTACTS.iter().filter(|contact| contact.has_gap()) {
            laws.hold(contact, true, &mut seen);
        }
    }
    assert!(seen.leave > 10 && seen.stick > 20 && seen.slide > 50, "{seen:?}");
}

#[test]
fn crates_of_random_numbers_rest_slide_and_tip_by_the_laws() {
    let (mut numbers, mut seen) = (Numbers(7), Seen::default());
    for _ in 0..100 {
        let [mass, length, time] = [numbers.unit(), numbers.unit(), numbers.unit()];
        let [a, b, c] = [length * numbers.positive(), length * numbers.positive(), length * numbers.positive()];
        let inside = |x: f64, part: f64| 0.45 * x * part;
        let center_of_mass =
            Vector3::new(inside(a, numbers.signed()), inside(b, numbers.signed()), inside(c, numbers.signed()));
        let m = mass * numbers.positive();
        let solid = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (m / 12.0);
        let down = -1.0 - numbers.next();
        let g = length / (time * time) * Vector3::new(1.5 * numbers.signed(), 1.5 * numbers.signed(), down);
        let off = Matrix3::identity() * center_of_mass.norm_squared() - center_of_mass * center_of_mass.transpose();
        let inertia = Matrix3::from_diagonal(&solid) + off * m;
        let cargo = RigidBody { mass: m, center_of_mass, inertia };
        let kernel = Crate { cargo, g, a, b, c, mu: numbers.next(), e: 0.0 }.kernel().unwrap();
        let q = Isometry3::translation(length * numbers.any(), length * numbers.any(), 0.5 * c);
        let z = SVector::<f64, 6>::zeros();
        let run = ContactRun::new(&kernel).adaptive(1e-9, 1e-9).run(q, z, 0.0..1e-9 * time).unwrap();
        let forces = *run.forces(0.0).unwrap();
        let w = kernel.contact_jacobian(0.0, &q);
        let (columns, matrix) = delassus(kernel.mass_matrix(0.0, &q), &w);
        // At rest rates change by accelerations alone.
        let rates = w.transpose() * (kernel.acceleration(0.0, &q, &z, &()) + columns * forces);
        let friction = kernel.friction(0.0, &q, &z, &());
        let laws = Laws { matrix, forces, rates, friction, slips: None };
        let gaps = kernel.gaps(0.0, &q);
        for (i, contact) in CrateKernel::CONTACTS.iter().enumerate() {
            laws.hold(contact, gaps[i] < 0.5 * c, &mut seen);
        }
    }
    assert!(seen.leave > 20 && seen.stick > 50 && seen.slide > 50, "{seen:?}");
}
