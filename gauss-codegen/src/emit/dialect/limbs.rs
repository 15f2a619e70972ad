//! Long methods of limbs that are alike, written with vectors: a lane for each limb.
//!
//! Only where the scalar is `f64` and packs are looked for. There is one form: where there are no vectors the runtime
//! has arrays in their place.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::quote;

use crate::algebra::{Expr, Map};
use crate::kernel::{Kernel, Program};
use crate::program::{Leaf, Operand};
use crate::targets::rust::{self, limbs};
use crate::terms::Twin;

use crate::emit::dialect::program::{KernelDialect, ScalarTokens};

/// Instructions from which on a program is written so, and up to which it is one function.
const LENGTHS: std::ops::RangeInclusive<usize> = 256..=65_536;

/// Relation of symbols to limbs.
#[derive(Default)]
pub struct LimbSymbols(Map<u32, Leaf>);

impl LimbSymbols {
    /// Limbs of coordinates, speeds and so on, of numbers, and of constants that these determine.
    pub fn of<'g>(twins: &[(Expr<'g>, Twin)], kernel: &Kernel<'g>) -> Self {
        let mut limbs_of: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (_, twin) in twins {
            let limbs = limbs_of.entry(twin.slot).or_default();
            if !limbs.contains(&twin.limb) {
                limbs.push(twin.limb);
                limbs.sort_unstable();
            }
        }
        let mut leaves: Map<u32, Leaf> = Map::default();
        for (symbol, twin) in twins {
            let limbs = limbs_of.get(&twin.slot).map_or(&[][..], Vec::as_slice);
            let Some(lane) = limbs.iter().position(|limb| *limb == twin.limb) else { continue };
            let leaf = Leaf { class: twin.slot as u64, limb: twin.limb, lane, lanes: limbs.len() };
            leaves.insert(symbol.key(), leaf);
        }
        if !leaves.is_empty() {
            for (symbol, definition) in &kernel.folded {
                let program = Program::lower(&[*definition]);
                let leaf = |symbol: Expr<'g>| leaves.get(&symbol.key()).copied();
                if let [Some(leaf)] = program.likeness_of_outputs(leaf)[..] {
                    leaves.insert(symbol.key(), leaf);
                }
            }
        }
        Self(leaves)
    }

    /// The statements of a program, and its outputs as expressions; nothing where little of it is alike.
    pub fn statements<'g>(
        &self,
        program: &Program<'g>,
        symbols: &Map<u32, TokenStream>,
        (private, scalar): (&TokenStream, &ScalarTokens<'_>),
    ) -> Option<(TokenStream, Vec<TokenStream>)> {
        if self.0.is_empty() || !LENGTHS.contains(&program.instructions.len()) {
            return None;
        }
        let dialect = KernelDialect { symbols, scalar };
        let leaf = |symbol: Expr<'g>| self.0.get(&symbol.key()).copied();
        // What is alike stands side by side.
        let place = |symbol: Expr<'g>| {
            let name = rust::operand(&Operand::Input(symbol), &dialect).to_string();
            leaf(symbol).map_or((u64::MAX, 0, name.len(), name), |leaf| (leaf.class, leaf.lane, 0, String::new()))
        };
        let code = program.clone().with_angles_together(place);
        let packed = code.with_limbs_together(leaf, &rust::rows_of_angles(&code))?;
        let functions =
            |lanes: usize| if lanes == 2 { quote!(#private::limbs::two) } else { quote!(#private::limbs::four) };
        Some(limbs::statements(&code, &packed, &dialect, &functions))
    }
}
