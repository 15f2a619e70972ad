//! The body's parameters as symbols, and integrals over the body as moments.

use crate::algebra::{Expr, Graph, Map};
use crate::terms::{Role, Shape};

use crate::mechanics::kinematics::vector::Triple;
use crate::mechanics::name::Name;

/// Quantities that the scene's body has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BodyShape {
    pub inertia: Shape,
    /// The inertia is about G.
    pub central: bool,
    pub center_of_mass: bool,
    pub added_mass: Option<Shape>,
    pub gravity: Option<Shape>,
    pub displaced_mass: bool,
    pub center_of_buoyancy: bool,
}

/// A component of a parameter: row and column for matrices, row alone for vectors.
#[derive(Clone, Copy, Debug)]
pub struct ParameterSymbol<'g> {
    pub symbol: Expr<'g>,
    pub quantity: Role,
    pub row: usize,
    pub column: usize,
}

/// Values of a quantity that is not read from a parameter of its own: one value, or the components in order.
#[derive(Clone, Debug)]
pub struct QuantityValues<'g> {
    pub quantity: Role,
    /// Expressions of parameters and numbers, of mass data also of the instant at which these are taken.
    pub values: Vec<Expr<'g>>,
}

impl QuantityValues<'_> {
    /// Whether they are the same at all times.
    pub fn is_constant(&self) -> bool {
        self.values.iter().all(|value| value.is_constant())
    }
}

/// The body as the derivation sees it; entries depend on parameters, and where mass varies on the instant of mass data.
#[derive(Clone)]
pub struct Body<'g> {
    pub mass: Expr<'g>,
    /// c = G − O, body axes.
    pub center_of_mass: Triple<'g>,
    /// I_O, body axes.
    pub inertia: [Triple<'g>; 3],
    /// I_G, where that is given: I_O is then a sum of it.
    pub central: Option<[Triple<'g>; 3]>,
    /// Added mass in the order (u, ω), body axes, pole O.
    pub added_mass: Option<Vec<Vec<Expr<'g>>>>,
    /// Acceleration of free fall, observer's axes.
    pub gravity: Option<Triple<'g>>,
    /// Mass of the displaced fluid and its centre from O, body axes.
    pub displaced: Option<(Expr<'g>, Triple<'g>)>,
    pub parameters: Vec<ParameterSymbol<'g>>,
}

struct Symbols<'g> {
    graph: &'g Graph,
    /// Which of several bodies: an index of every letter; empty for the only one.
    suffix: Name,
    list: Vec<ParameterSymbol<'g>>,
}

impl<'g> Symbols<'g> {
    fn scalar(&mut self, text: &str, latex: &str, quantity: Role) -> Expr<'g> {
        self.push(text.to_owned(), latex.to_owned(), quantity, 0, 0)
    }

    fn push(&mut self, text: String, latex: String, quantity: Role, row: usize, column: usize) -> Expr<'g> {
        let symbol = if self.suffix.text.is_empty() {
            self.graph.symbol(text, latex, true)
        } else {
            let Name { text, latex } = Name { text, latex }.of(&self.suffix);
            self.graph.symbol(text, latex, true)
        };
        self.list.push(ParameterSymbol { symbol, quantity, row, column });
        symbol
    }

    fn vector<const N: usize>(&mut self, name: &str, quantity: Role) -> [Expr<'g>; N] {
        std::array::from_fn(|i| self.push(format!("{name}{}", i + 1), format!("{name}_{{{}}}", i + 1), quantity, i, 0))
    }

    /// Lower triangle as symbols, mirrored.
    fn symmetric(&mut self, n: usize, name: &str, quantity: Role) -> Vec<Vec<Expr<'g>>> {
        let mut matrix = vec![vec![self.graph.zero(); n]; n];
        for i in 0..n {
            for j in i..n {
                let text = format!("{name}{}{}", i + 1, j + 1);
                let latex = format!("{name}_{{{}{}}}", i + 1, j + 1);
                // The entry below the diagonal is read; `kernel()` checks that the one above agrees.
                matrix[i][j] = self.push(text, latex, quantity, j, i);
                matrix[j][i] = matrix[i][j];
            }
        }
        matrix
    }
}

fn diagonal<'g>(graph: &'g Graph, entries: &[Expr<'g>]) -> Vec<Vec<Expr<'g>>> {
    let n = entries.len();
    (0..n).map(|i| (0..n).map(|j| if i == j { entries[i] } else { graph.zero() }).collect()).collect()
}

impl<'g> Body<'g> {
    /// Symbols for what the shape has; zero for what it leaves out. `up` is the observer's axis that gravity opposes.
    pub fn new(graph: &'g Graph, shape: BodyShape, up: usize) -> Self {
        Self::named(graph, shape, up, Name::new("", ""))
    }

    /// One of several bodies.
    pub fn named(graph: &'g Graph, shape: BodyShape, up: usize, suffix: Name) -> Self {
        let zero = graph.zero();
        let mut symbols = Symbols { graph, suffix, list: Vec::new() };
        let mass = symbols.scalar("m", "m", Role::Mass);
        let center_of_mass = if shape.center_of_mass { symbols.vector("c", Role::CenterOfMass) } else { [zero; 3] };
        let (letter, role) = if shape.central { ("IG", Role::CentralInertia) } else { ("I", Role::Inertia) };
        let inertia = match shape.inertia {
            Shape::Scalar => diagonal(graph, &[symbols.scalar(letter, letter, role); 3]),
            Shape::Vector3 => diagonal(graph, &symbols.vector::<3>(letter, role)),
            _ => symbols.symmetric(3, letter, role),
        };
        let given: [Triple<'g>; 3] = std::array::from_fn(|i| std::array::from_fn(|j| inertia[i][j]));
        let central = shape.central.then_some(given);
        let about_o = |central: [Triple<'g>; 3]| {
            let lever = lever(mass, &center_of_mass);
            std::array::from_fn(|i| std::array::from_fn(|j| central[i][j] + lever[i][j]))
        };
        let inertia = central.map_or(given, about_o);
        let added_mass = shape.added_mass.map(|shape| match shape {
            Shape::Vector6 => diagonal(graph, &symbols.vector::<6>("X", Role::AddedMass)),
            _ => symbols.symmetric(6, "X", Role::AddedMass),
        });
        let gravity = shape.gravity.map(|shape| match shape {
            Shape::Scalar => {
                let g = symbols.scalar("g", "g", Role::Gravity);
                std::array::from_fn(|i| if i == up { -g } else { zero })
            }
            _ => symbols.vector("g", Role::Gravity),
        });
        let displaced = shape.displaced_mass.then(|| {
            let mass = symbols.scalar("md", "m_d", Role::DisplacedMass);
            let center = if shape.center_of_buoyancy { symbols.vector("h", Role::CenterOfBuoyancy) } else { [zero; 3] };
            (mass, center)
        });
        Self { mass, center_of_mass, inertia, central, added_mass, gravity, displaced, parameters: symbols.list }
    }

    /// Puts values in the place of the symbols of a quantity, as many as its shape has.
    pub fn assign(&mut self, values: &QuantityValues<'g>) {
        let own = |p: &ParameterSymbol<'g>| p.quantity == values.quantity;
        let symbols = self.parameters.iter().filter(|p| own(p)).map(|p| p.symbol.key());
        let values: Map<u32, Expr<'g>> = symbols.zip(values.values.iter().copied()).collect();
        self.parameters.retain(|p| !own(p));
        let put = |e: &mut Expr<'g>| *e = e.substitute(&values);
        put(&mut self.mass);
        self.center_of_mass.iter_mut().for_each(put);
        self.inertia.iter_mut().flatten().for_each(put);
        self.central.iter_mut().flatten().flatten().for_each(put);
        self.gravity.iter_mut().flatten().for_each(put);
        self.added_mass.iter_mut().flatten().flatten().for_each(put);
        if let Some((mass, center)) = &mut self.displaced {
            put(mass);
            center.iter_mut().for_each(put);
        }
    }

    /// `∫ x dm = m c`.
    pub fn first_moment(&self) -> Triple<'g> {
        self.center_of_mass.map(|c| self.mass * c)
    }

    /// I_G = I_O − m (c² 1 − c cᵀ), body axes, if it is not given: numbers once the parameters are known.
    pub fn central_inertia(&self) -> [Triple<'g>; 3] {
        let lever = lever(self.mass, &self.center_of_mass);
        let moved = |i: usize, j: usize| match (self.inertia[i][j], lever[i][j]) {
            (inertia, lever) if lever.is_zero() => inertia,
            (inertia, lever) => (inertia - lever).opaque(),
        };
        self.central.unwrap_or_else(|| std::array::from_fn(|i| std::array::from_fn(|j| moved(i, j))))
    }

    /// `J = ∫ x xᵀ dm = ½ tr(I_O) 1 − I_O`.
    pub fn second_moment(&self) -> [Triple<'g>; 3] {
        let half_trace = (0..3).map(|i| self.inertia[i][i]).sum::<Expr<'g>>().half();
        std::array::from_fn(|i| {
            std::array::from_fn(|j| if i == j { half_trace - self.inertia[i][j] } else { -self.inertia[i][j] })
        })
    }
}

/// `m (c² 1 − c cᵀ)`: what the inertia about O has beyond that about G.
fn lever<'g>(mass: Expr<'g>, c: &Triple<'g>) -> [Triple<'g>; 3] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match i == j {
            true => mass * ((i + 1)..(i + 3)).map(|k| c[k % 3].powi(2)).sum::<Expr<'g>>(),
            false => -(mass * c[i] * c[j]),
        })
    })
}

/// A vector field over the body that is affine in the body coordinates x: `constant + Σ x_j · linear[j]`.
#[derive(Clone, Copy)]
pub struct AffineField<'g> {
    pub constant: Triple<'g>,
    pub linear: [Triple<'g>; 3],
}

#[cfg(test)]
impl<'g> AffineField<'g> {
    /// Reads the field off its components, which must be affine in the symbols x.
    pub fn of(components: &Triple<'g>, x: &Triple<'g>) -> Self {
        let linear: [Triple<'g>; 3] = std::array::from_fn(|j| components.map(|e| e.partial(x[j])));
        let zero = components[0].graph().zero();
        let at_origin = x.iter().map(|e| (e.key(), zero)).collect();
        Self { constant: components.map(|e| e.substitute(&at_origin)), linear }
    }

    pub fn map(&self, f: impl Fn(Expr<'g>) -> Expr<'g>) -> Self {
        Self { constant: self.constant.map(&f), linear: self.linear.map(|v| v.map(&f)) }
    }

    /// The value at a body point.
    pub fn at(&self, x: &Triple<'g>) -> Triple<'g> {
        std::array::from_fn(|i| self.constant[i] + (0..3).map(|j| self.linear[j][i] * x[j]).sum())
    }
}

/// `∫ f·h dm` of two affine fields: monomials in x become moments (1 → m, x_i → m c_i, x_i x_j → J_ij).
pub fn integrate_product<'g>(body: &Body<'g>, f: &AffineField<'g>, h: &AffineField<'g>) -> Expr<'g> {
    let (first, second) = (body.first_moment(), body.second_moment());
    let mut total = body.mass * crate::mechanics::kinematics::vector::dot(&f.constant, &h.constant);
    for j in 0..3 {
        let mixed = crate::mechanics::kinematics::vector::dot(&f.constant, &h.linear[j])
            + crate::mechanics::kinematics::vector::dot(&f.linear[j], &h.constant);
        total = total + first[j] * mixed;
        for k in 0..3 {
            total = total + second[j][k] * crate::mechanics::kinematics::vector::dot(&f.linear[j], &h.linear[k]);
        }
    }
    total
}
