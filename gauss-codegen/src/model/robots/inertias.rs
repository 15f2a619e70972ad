//! Mass data that no body has: what kernels would refuse, where it is written.

use proc_macro2::Ident;
use syn::ext::IdentExt;

use super::clauses::Robot;
use super::description::{Fault, Inertial};
use super::rotation::Matrix;

/// What the largest moment may exceed the sum of the others by, as part of all.
const SLACK: f64 = 16.0 * f64::EPSILON;

impl Robot<'_> {
    /// What moves as one and has moments that no body has, but for bodies whose triangle inequality is `waived`.
    pub fn impossible(&self, waived: &[Option<Ident>]) -> Vec<Fault> {
        let owners = (0..self.links.len()).filter(|&link| self.structure.owner_of[link] == link && self.moves(link));
        let parts = owners.filter_map(|link| Some((link, self.merged(link)?)));
        let fault = |(link, own): (usize, Inertial)| {
            let is_waived =
                waived.iter().any(|name| name.as_ref().is_none_or(|name| name.unraw() == self.links[link].unraw()));
            let at = self.description.links[link].at;
            broken_rule(&own, is_waived, &self.links[link]).map(|rule| {
                let name = &self.description.links[link].name;
                Fault {
                    at,
                    message: format!("`{name}`, with what is fixed to it, has an inertia that no body has: {rule}"),
                }
            })
        };
        parts.filter_map(fault).collect()
    }
}

fn broken_rule(own: &Inertial, waived: bool, name: &Ident) -> Option<String> {
    let mut moments = principal(own.inertia);
    moments.sort_by(f64::total_cmp);
    let [least, middle, most] = moments;
    let slack = SLACK * (least.abs() + middle.abs() + most.abs());
    let shown = format!("the principal moments are {least:.3e}, {middle:.3e}, {most:.3e}");
    // Two that are zero are not stated.
    let stated = least.abs().max(middle.abs()) > slack;
    if least < -slack {
        Some(format!("{shown}, and none is negative"))
    } else if stated && most - least - middle > slack && !waived {
        Some(format!(
            "{shown}, and the largest is at most the sum of the others; mend it, or write \
             `waive(triangle_inequality = {name})`"
        ))
    } else {
        None
    }
}

/// The eigenvalues of a symmetric matrix, by turns that bring its entries beside the diagonal to zero (Jacobi).
fn principal(mut a: Matrix) -> [f64; 3] {
    // Each round squares what is left of them.
    for _ in 0..16 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let slope = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let tangent = slope.signum() / (slope.abs() + slope.hypot(1.0));
            let cosine = 1.0 / tangent.hypot(1.0);
            let sine = tangent * cosine;
            for row in &mut a {
                (row[p], row[q]) = (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (cosine * a[p][k] - sine * a[q][k], sine * a[p][k] + cosine * a[q][k]);
            }
        }
    }
    [a[0][0], a[1][1], a[2][2]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::robots::rotation::{Rotation, turned_tensor};

    /// Turned moments are the same moments.
    #[test]
    fn principal_moments() {
        for angles in [[0.0; 3], [0.3, -0.7, 1.1], [2.0, 0.5, -0.1]] {
            let turn = Rotation::from_angles(angles).matrix;
            let mut found = principal(turned_tensor(&turn, &[[1.0, 0.0, 0.0], [0.0, 2.5, 0.0], [0.0, 0.0, 3.0]]));
            found.sort_by(f64::total_cmp);
            for (found, expected) in found.into_iter().zip([1.0, 2.5, 3.0]) {
                assert!((found - expected).abs() < 16.0 * f64::EPSILON, "{found} {expected}");
            }
        }
    }
}
