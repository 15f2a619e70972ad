//! Which part of a scene is to blame where a check fails that no mistake of this crate makes fail.

use crate::algebra::{ErrorBound, Expr, Notation, Number, Precise, Scalar, decimal};
use crate::error::Error;
use crate::mechanics::{Body, Tree};
use crate::terms::Role;

use super::domains::value_of_literals;
use super::translated::Provenance;

/// Whether a symmetric matrix has a negative eigenvalue: one of its principal minors is negative.
fn is_indefinite(a: &[[Precise; 3]; 3]) -> bool {
    let pairs = [(0, 1), (0, 2), (1, 2)];
    let minor = |(i, j): (usize, usize)| a[i][i] * a[j][j] - a[i][j] * a[j][i];
    let cofactor = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[1][i] * a[2][j] - a[1][j] * a[2][i]
    };
    let determinant = (0..3).fold(Precise::number(0.0), |sum, k| sum + a[0][k] * cofactor(k));
    let size = (0..3).map(|i| a[i][i].to_f64().abs()).fold(0.0, f64::max);
    // Rods have a moment of zero: beside the roundings of 256 digits that is far below this.
    let negative = |minor: Precise, power: i32| minor.to_f64() < -1e-50 * size.powi(power);
    (0..3).any(|i| negative(a[i][i], 1))
        || pairs.into_iter().any(|pair| negative(minor(pair), 2))
        || negative(determinant, 3)
}

impl<'g> Provenance<'g> {
    /// Why a check fails that no mistake of this crate makes fail: bodies that none can be, numbers out of its reach.
    pub fn cause_of_failure(&self, tree: &Tree<'g>) -> Option<Error> {
        self.impossible_body(tree).or_else(|| {
            let (span, _) = self.extreme.first()?;
            let list: Vec<String> =
                self.extreme.iter().map(|(_, value)| format!("`{}`", decimal(*value, Notation::Text))).collect();
            let (are, they) = if list.len() == 1 { ("is", "it is") } else { ("are", "they are") };
            Some(Error::new(
                *span,
                format!(
                    "{} {are} out of reach: not even numbers of 256 binary digits tell whether the equations are right; \
                     choose units in which {they} nearer to 1",
                    list.join(", ")
                ),
            ))
        })
    }

    /// A body whose mass data are literals and that has a negative moment of inertia about its centre of mass.
    fn impossible_body(&self, tree: &Tree<'g>) -> Option<Error> {
        let clause = self.mass_data.bodies.iter().find(|clause| {
            let body = tree.links.get(clause.link).and_then(|link| link.body());
            body.and_then(|body| self.central_moments(body)).is_some_and(|moments| is_indefinite(&moments))
        })?;
        let own = if clause.name.is_some() { &clause.values } else { &self.mass_data.unnamed };
        let mut roles = own.iter().map(|value| (value.span, value.own.quantity));
        let inertia = roles.find(|(_, role)| matches!(role, Role::Inertia | Role::CentralInertia));
        let (span, word) = inertia.map_or((clause.span, Role::Inertia.word()), |(span, role)| (span, role.word()));
        let rule = match word == Role::CentralInertia.word() {
            true => String::new(),
            false => format!(
                "; `{word}` is about O, m (|c|² 1 − c cᵀ) more; an inertia about the centre of mass is written \
                 `{}`",
                Role::CentralInertia.word()
            ),
        };
        let message =
            format!("no body has this `{word}`: about its centre of mass a moment of inertia is negative{rule}");
        Some(Error::new(span, message))
    }

    /// I_O − m(|c|² 1 − c cᵀ), where literals alone determine it.
    fn central_moments(&self, body: &Body<'g>) -> Option<[[Precise; 3]; 3]> {
        let mass = self.known(body.mass)?;
        let mut center = [Precise::number(0.0); 3];
        for (value, e) in center.iter_mut().zip(body.center_of_mass) {
            *value = self.known(e)?;
        }
        let square = center.iter().fold(Precise::number(0.0), |sum, c| sum + *c * *c);
        let mut moments = [[Precise::number(0.0); 3]; 3];
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let own = if i == j { square } else { Precise::number(0.0) };
            moments[i][j] = self.known(body.inertia[i][j])? - mass * (own - center[i] * center[j]);
        }
        Some(moments)
    }

    /// The value of what literals alone determine.
    pub fn known(&self, value: Expr<'g>) -> Option<Precise> {
        value_of_literals(value, &self.literals)
    }

    /// The same with what rounding to doubles may do to it.
    pub fn rounded(&self, value: Expr<'g>) -> Option<ErrorBound> {
        value_of_literals(value, &self.literals)
    }
}
