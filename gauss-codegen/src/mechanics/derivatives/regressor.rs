//! The forces of inertia as a linear function of inertial parameters, `Y π`: what identification solves for.
//!
//! ∂C/∂ż is linear in the moments of the masses and in the added mass, not in the centre of mass: in it `c = s/m` is
//! put in place of c, with the first moment s, and the coefficients of m, s, I_O and X are its derivatives by them.
//! Uniform gravity is an acceleration of the observer and goes with the masses; the elements of the loads, and
//! buoyancy, do not.

use crate::algebra::{Expr, Graph, Map};
use crate::derivatives::DirectionalDerivatives;

use crate::mechanics::formula::{Formula, Method};
use crate::mechanics::links::link::Matter;
use crate::mechanics::matter::body::Body;
use crate::mechanics::system::System;

/// Forces of inertia, affine in the inertial parameters, and these.
pub struct Regressor<'g> {
    /// The forces of inertia, in terms of a symbol for each parameter, along which they are differentiated.
    pub differentiated: DirectionalDerivatives<'g>,
    /// π, and the generalised forces of everything else.
    pub formulas: [Formula<'g>; 2],
    pub parameters: Vec<InertialParameter<'g>>,
}

/// A number in which the forces of inertia are linear.
pub struct InertialParameter<'g> {
    /// In terms of what the user calls its factors.
    pub name: String,
    value: Expr<'g>,
    /// Symbol that stands for it where forces of inertia are differentiated: their derivatives do not read it, unless a
    /// mass is something else besides.
    pub symbol: Expr<'g>,
}

/// The inertial parameters of a scene, and what takes the place of the symbols of fields.
pub struct InertialParameters<'a, 'g> {
    graph: &'g Graph,
    names: &'a Map<u32, String>,
    list: Vec<InertialParameter<'g>>,
    /// Masses, inertias and added masses.
    replacement: Map<u32, Expr<'g>>,
    /// c = s/m, by the mass and c: bodies may share the one or the other.
    centers: Map<(u32, u32), Expr<'g>>,
    /// Entries of I_O in which forces are linear where I_G is given.
    about_o: Map<u32, Expr<'g>>,
}

impl<'a, 'g> InertialParameters<'a, 'g> {
    /// Parameters of all bodies and particles; `names` are those of the numbers of fields.
    pub fn new(system: &System<'g>, names: &'a Map<u32, String>) -> Self {
        let graph = system.scene.graph;
        let (replacement, centers, about_o) = (Map::default(), Map::default(), Map::default());
        let mut parameters = Self { graph, names, list: Vec::new(), replacement, centers, about_o };
        for link in &system.scene.tree.links {
            match &link.matter {
                Matter::Body(body) => parameters.take_body(body),
                Matter::Particle(mass) => parameters.take(*mass),
                Matter::Nothing => {}
            }
        }
        parameters
    }

    /// Takes a number for a parameter if it is one of a field, and was not taken before.
    fn take(&mut self, value: Expr<'g>) {
        if let Some(name) = self.names.get(&value.key())
            && !self.replacement.contains_key(&value.key())
        {
            let symbol = self.push(name.clone(), value);
            self.replacement.insert(value.key(), symbol);
        }
    }

    fn push(&mut self, name: String, value: Expr<'g>) -> Expr<'g> {
        let symbol = self.graph.symbol(name.clone(), name.clone(), false);
        self.list.push(InertialParameter { name, value, symbol });
        symbol
    }

    fn take_body(&mut self, body: &Body<'g>) {
        self.take(body.mass);
        for c in body.center_of_mass {
            let key = (body.mass.key(), c.key());
            let Some(name) = self.names.get(&c.key()).filter(|_| !self.centers.contains_key(&key)) else { continue };
            let center = match self.names.get(&body.mass.key()) {
                Some(mass) => self.push(format!("{mass} * {name}"), body.mass * c) * body.mass.recip(),
                // With a mass that is no parameter forces are linear in c.
                None => self.push(name.clone(), c),
            };
            self.centers.insert(key, center);
        }
        for (i, j) in (0..3).flat_map(|i| (i..3).map(move |j| (i, j))) {
            match body.central {
                None => self.take(body.inertia[i][j]),
                Some(_) => self.take_about_o(body, [i, j]),
            }
        }
        for (i, row) in body.added_mass.iter().flatten().enumerate() {
            row[i..].iter().for_each(|&x| self.take(x));
        }
    }

    /// An entry of I_O = I_G + m (c² 1 − c cᵀ): in I_G and c forces are not linear.
    fn take_about_o(&mut self, body: &Body<'g>, [i, j]: [usize; 2]) {
        let entry = body.inertia[i][j];
        let free = [entry.is_zero(), entry.as_number().is_some(), self.about_o.contains_key(&entry.key())];
        if let (Some(mass), [false, false, false]) = (self.names.get(&body.mass.key()), free) {
            let symbol = self.push(format!("I_O[{i}][{j}] of {mass}"), entry);
            self.about_o.insert(entry.key(), symbol);
        }
    }

    /// The body by its first moment: from the start, because common factors are pulled out of sums as soon as these are
    /// formed.
    pub fn by_first_moment(&self, body: &Body<'g>) -> Body<'g> {
        let center = |c: Expr<'g>| self.centers.get(&(body.mass.key(), c.key())).copied().unwrap_or(c);
        let about_o = |e: Expr<'g>| self.about_o.get(&e.key()).copied().unwrap_or(e);
        let inertia = body.inertia.map(|row| row.map(about_o));
        Body { center_of_mass: body.center_of_mass.map(center), inertia, central: None, ..body.clone() }
    }

    /// `residuals` are arrangements of the forces of inertia, weight and buoyancy of bodies by their first moments,
    /// `forces` those of all else; `defined` are symbols that stand for expressions of the arguments.
    ///
    /// # Errors
    /// The name of a parameter that something is divided by: the forces are not linear in it.
    pub fn regressor(
        self,
        residuals: &[Vec<Expr<'g>>],
        forces: &[Expr<'g>],
        defined: Vec<Expr<'g>>,
    ) -> Result<Regressor<'g>, String> {
        let Self { graph, list, replacement, .. } = self;
        let replaced =
            |row: &Vec<Expr<'g>>| -> Vec<Expr<'g>> { row.iter().map(|e| e.substitute(&replacement)).collect() };
        let arrangements: Vec<Vec<Expr<'g>>> = residuals.iter().map(replaced).collect();
        let nothing: Map<u32, Expr<'g>> = list.iter().map(|p| (p.symbol.key(), graph.zero())).collect();
        let rest = |row: &Vec<Expr<'g>>| forces.iter().zip(row).map(|(f, r)| *f - r.substitute(&nothing)).collect();
        let Some(others) = graph.defined(|| arrangements.iter().map(rest).collect()) else {
            let divides = |parameter: &&InertialParameter<'g>| {
                let vanishing = Map::from_iter([(parameter.symbol.key(), graph.zero())]);
                let all = || arrangements.iter().flatten().for_each(|e| _ = e.substitute(&vanishing));
                graph.defined(all).is_none()
            };
            let found = list.iter().find(divides).or(list.first());
            return Err(found.map(|parameter| parameter.name.clone()).unwrap_or_default());
        };
        let formulas = [
            Formula {
                method: Method::InertialParameters,
                arrangements: vec![list.iter().map(|parameter| parameter.value).collect()],
            },
            Formula { method: Method::OtherForces, arrangements: others },
        ];
        let directions = list.iter().map(|parameter| vec![(parameter.symbol, graph.one())]).collect();
        Ok(Regressor {
            differentiated: DirectionalDerivatives { arrangements, defined, directions, derived: Vec::new() },
            formulas,
            parameters: list,
        })
    }
}
