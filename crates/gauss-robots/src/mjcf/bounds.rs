//! Bounds by which the compiler of MuJoCo changes mass data.

use roxmltree::Node;

use crate::description::Inertial;
use crate::rotation::{Matrix, Triple, principal, turned_tensor};
use crate::xml::Reading;

/// Bounds for mass data that are too small, or are of no body: the compiler changes them.
#[derive(Clone, Copy, Default)]
pub struct Bounds {
    mass: f64,
    moment: f64,
    balance: bool,
}

impl Bounds {
    pub fn read<'a>(&mut self, node: Node<'a, 'a>, reading: &mut Reading<'a>) {
        self.mass = reading.number(node, "boundmass").unwrap_or(self.mass);
        self.moment = reading.number(node, "boundinertia").unwrap_or(self.moment);
        self.balance |= reading.text(node, "balanceinertia") == Some("true");
    }

    /// In the order of MuJoCo's `mjCBody::Compile`.
    pub fn kept(self, own: Option<Inertial>) -> Option<Inertial> {
        let nothing = Inertial { mass: 0.0, center: [0.0; 3], inertia: [[0.0; 3]; 3] };
        let bounded = self.mass > 0.0 || self.moment > 0.0;
        let mut own = own.or(bounded.then_some(nothing))?;
        own.mass = own.mass.max(self.mass);
        let (mut moments, axes) = principal(own.inertia);
        let sum: f64 = moments.iter().sum();
        let lacking = |moment: &f64| *moment < self.moment;
        let unbalanced = self.balance && moments.iter().any(|moment| 2.0 * moment > sum);
        if unbalanced || moments.iter().any(lacking) {
            moments = moments.map(|moment| moment.max(self.moment));
            let sum: f64 = moments.iter().sum();
            let unbalanced = self.balance && moments.iter().any(|moment| 2.0 * moment > sum);
            own.inertia = match unbalanced {
                true => diagonal_of([sum / 3.0; 3]),
                false => turned_tensor(&axes, &diagonal_of(moments)),
            };
        }
        Some(own)
    }
}

pub fn diagonal_of([a, b, c]: Triple) -> Matrix {
    [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]
}
