//! Normal forms modulo an ideal, for proofs: with a Gröbner basis of a rotation matrix's relations two expressions in R
//! are equal exactly when their normal forms are.

use crate::algebra::expressions::graph::{Expr, Graph};
use crate::algebra::normal_form::polynomial::{Monomial, Polynomial};
use crate::algebra::rational::Rational;

/// A Gröbner basis (graded lexicographic order).
pub struct Ideal<'g> {
    basis: Vec<Polynomial<'g>>,
}

impl<'g> Ideal<'g> {
    /// The relations of a rotation matrix: RᵀR = 1, RRᵀ = 1, and every entry equal to its cofactor.
    pub fn of_rotation(graph: &'g Graph, r: &[[Expr<'g>; 3]; 3]) -> Self {
        let identity = |i: usize, j: usize| if i == j { graph.one() } else { graph.zero() };
        let mut relations = Vec::new();
        for i in 0..3 {
            for j in 0..3 {
                relations.push((0..3).map(|k| r[k][i] * r[k][j]).sum::<Expr<'g>>() - identity(i, j));
                relations.push((0..3).map(|k| r[i][k] * r[j][k]).sum::<Expr<'g>>() - identity(i, j));
                let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
                relations.push(r[i1][j1] * r[i2][j2] - r[i1][j2] * r[i2][j1] - r[i][j]);
            }
        }
        Self::generated_by(relations)
    }

    /// Buchberger's algorithm.
    pub fn generated_by(relations: Vec<Expr<'g>>) -> Self {
        let mut ideal = Self { basis: Vec::new() };
        for relation in relations {
            ideal.insert(relation.expand(usize::MAX).expect("no limit"));
        }
        let mut done = 0;
        while done < ideal.basis.len() {
            for other in 0..done {
                let pair = s_polynomial(&ideal.basis[done], &ideal.basis[other]);
                if let Some(pair) = pair {
                    ideal.insert(pair);
                }
            }
            done += 1;
        }
        ideal
    }

    fn insert(&mut self, p: Polynomial<'g>) {
        let rest = self.reduce(&p);
        if !rest.is_zero() {
            self.basis.push(rest);
        }
    }

    /// The normal form: no monomial of it is a multiple of a leading monomial of the basis.
    pub fn reduce(&self, p: &Polynomial<'g>) -> Polynomial<'g> {
        let mut open = p.clone();
        let mut result = Polynomial::zero(p.graph());
        while let Some((monomial, coefficient)) = open.terms().last_key_value() {
            let (monomial, coefficient) = (monomial.clone(), *coefficient);
            let hit = self.basis.iter().find_map(|g| {
                let (leading, c) = leading(g);
                monomial.over(leading).map(|rest| (g, rest, coefficient / c))
            });
            match hit {
                Some((g, rest, factor)) => subtract(&mut open, g, &rest, factor),
                None => {
                    open.add_term(monomial.clone(), -coefficient);
                    result.add_term(monomial, coefficient);
                }
            }
        }
        result
    }

    /// True when the expression vanishes wherever the relations hold.
    pub fn annihilates(&self, e: Expr<'g>) -> bool {
        self.reduce(&e.expand(usize::MAX).expect("no limit")).is_zero()
    }
}

fn leading<'a>(p: &'a Polynomial<'_>) -> (&'a Monomial, Rational) {
    let (m, c) = p.terms().last_key_value().expect("a basis element is not zero");
    (m, *c)
}

fn subtract<'g>(from: &mut Polynomial<'g>, g: &Polynomial<'g>, monomial: &Monomial, factor: Rational) {
    for (m, c) in g.terms() {
        from.add_term(m.times(monomial), -(factor * *c));
    }
}

/// The combination in which the leading terms cancel; `None` when they are coprime and it reduces to zero anyway.
fn s_polynomial<'g>(a: &Polynomial<'g>, b: &Polynomial<'g>) -> Option<Polynomial<'g>> {
    let ((la, ca), (lb, cb)) = (leading(a), leading(b));
    let shared = Monomial::new(
        la.factors
            .iter()
            .filter_map(|&(atom, n)| lb.factors.iter().find(|f| f.0 == atom).map(|f| (atom, n.min(f.1))))
            .collect(),
    );
    if shared.factors.is_empty() {
        return None;
    }
    let (fa, fb) = (lb.over(&shared)?, la.over(&shared)?);
    let mut result = Polynomial::zero(a.graph());
    subtract(&mut result, a, &fa, -ca.recip());
    subtract(&mut result, b, &fb, cb.recip());
    Some(result)
}
