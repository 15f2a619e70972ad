//! Rows of contacts: W of (ġ, s) = W z + …, and γ, what the rates of these have beside W ż.

use crate::algebra::Expr;

use crate::mechanics::scene::SystemScene;
use crate::mechanics::scene::contact::Contact;
use crate::mechanics::tidy::tidy;

/// All contacts on the level of velocities. Rows: of each contact its normal, then its tangents; of dry friction
/// tangents alone.
pub struct Contacts<'g> {
    /// ġ and s.
    pub rates: Vec<Expr<'g>>,
    /// W = ∂(ġ, s)/∂z.
    pub jacobian: Vec<Vec<Expr<'g>>>,
    /// γ of d(ġ, s)/dt = W ż + γ.
    pub bias: Vec<Expr<'g>>,
}

impl<'g> Contacts<'g> {
    pub fn new(scene: &SystemScene<'g>) -> Self {
        let of_contact = |contact: &Contact<'g>| {
            let normal = contact.gap.map(|gap| gap.derivative(&scene.rates));
            normal.into_iter().chain(contact.slips.iter().copied()).collect::<Vec<_>>()
        };
        let rates: Vec<Expr<'g>> = scene.contacts.iter().flat_map(of_contact).collect();
        let row = |e: &Expr<'g>| scene.speeds.iter().map(|&z| e.partial(z).group()).collect();
        Self {
            jacobian: rates.iter().map(row).collect(),
            bias: rates.iter().map(|e| e.derivative(&scene.rates).group()).collect(),
            rates,
        }
    }

    /// Whether a row of W is zero.
    pub fn is_still(&self, row: &[Expr<'g>]) -> bool {
        row.iter().all(|e| tidy(*e).is_zero())
    }

    /// Whether a row of W depends on no speed.
    pub fn is_affine(&self, row: &[Expr<'g>], speeds: &[Expr<'g>]) -> bool {
        row.iter().all(|e| e.as_number().is_some() || speeds.iter().all(|&z| tidy(e.partial(z)).is_zero()))
    }

    pub fn is_empty(&self) -> bool {
        self.rates.is_empty()
    }
}
