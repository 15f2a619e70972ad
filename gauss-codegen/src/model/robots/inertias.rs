//! Mass data that no body has: what kernels would refuse, where it is written.

use proc_macro2::Ident;
use syn::ext::IdentExt;

use super::clauses::Robot;
use gauss_robots::description::{Fault, Inertial};
use gauss_robots::rotation::principal;

/// Bound of the excess of the largest moment over the sum of the others, as part of all.
const SLACK: f64 = 16.0 * f64::EPSILON;

impl Robot<'_> {
    /// Faults of links that move as one and have moments that no body has, but for bodies whose triangle inequality is
    /// `waived`.
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
    let mut moments = principal(own.inertia).0;
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
