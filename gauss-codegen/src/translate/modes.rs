//! Bodies that deform: integrals of modes in symbols; their stiffness a potential, their damping a dissipation
//! function.

use proc_macro2::Span;

use crate::algebra::Expr;
use crate::error::Result;
use crate::mechanics::{Action, Coordinate, Deformation, Element, Force, Link, ModalIntegrals, Tree};
use crate::model::{Integral, ModesClause, Property};
use crate::terms::LawKind;
use crate::words::Unraw;

use super::laws::Law;
use super::translator::{Translator, bug};

type Triple<'g> = [Expr<'g>; 3];

/// Places of xx, yy, zz, xy, xz, yz of a symmetric tensor.
const PAIRS: [[usize; 3]; 3] = [[0, 3, 4], [3, 1, 5], [4, 5, 2]];

impl<'g> Translator<'_, 'g> {
    /// Contributions of modes to the links of their bodies.
    pub(super) fn deformations(&self, tree: &Tree<'g>) -> Result<Vec<Deformation<'g>>> {
        let of = |clause: &ModesClause| {
            let link = self.link(&clause.body)?;
            let coordinates = self.etas(clause)?;
            let matrix = self.integrals(clause, tree)?.matrix(self.graph, &coordinates);
            let twist = [Property::BodyVelocity, Property::BodyAngularVelocity];
            let mut rates: Vec<Expr<'g>> =
                twist.into_iter().flat_map(|part| self.velocity_of(link, part, tree)).collect();
            for name in &clause.coordinates {
                rates.push(self.rate_of_coordinate(name)?);
            }
            let gravity = tree.gravity.map(|g| tree.links[link].axes().to_body(&g).map(Expr::group));
            self.note_whole(clause, (&coordinates, &matrix), &tree.links[link]);
            Ok(Deformation { link, coordinates, rates, matrix, gravity })
        };
        self.model.modes.iter().map(of).collect()
    }

    /// Their stiffness and their damping, each with the place where it is written.
    pub(super) fn elements_of_modes(&self, tree: &Tree<'g>) -> Result<Vec<(Span, Element<'g>)>> {
        let mut elements = Vec::new();
        for clause in &self.model.modes {
            let name = format!("{} modes", clause.body.unraw());
            let etas = self.etas(clause)?;
            if let Some(stiffness) = self.matrix_of(clause, Integral::Stiffness, tree)? {
                let action = Action::Potential(half_form(&stiffness, &etas));
                elements.push((clause.span, Element::new(name.clone(), action)));
            }
            if let Some(damping) = self.matrix_of(clause, Integral::Damping, tree)? {
                let rates: Vec<Expr<'g>> =
                    clause.coordinates.iter().map(|q| self.rate_of_coordinate(q)).collect::<Result<_>>()?;
                let force = Force::Dissipation(half_form(&damping, &rates));
                elements.push((clause.span, Element::new(name, Action::Forces(vec![force]))));
            }
        }
        Ok(elements)
    }

    fn etas(&self, clause: &ModesClause) -> Result<Vec<Expr<'g>>> {
        let symbol = |name| match &self.declared.coordinates[self.declared.before + self.coordinate(name)?.0] {
            Coordinate::Scalar(symbol) => Ok(*symbol),
            _ => Err(bug(clause.span)),
        };
        clause.coordinates.iter().map(symbol).collect()
    }

    /// All integrals: zero where they are not given, M the unit matrix.
    fn integrals(&self, clause: &ModesClause, tree: &Tree<'g>) -> Result<ModalIntegrals<'g>> {
        let n = clause.coordinates.len();
        let (zero, one) = (self.graph.zero(), self.graph.one());
        let unit = || (0..n).map(|k| (0..n).map(|l| if k == l { one } else { zero }).collect()).collect();
        let entries = |integral: Integral| -> Result<Vec<Expr<'g>>> {
            let count = integral.sizes(n).into_iter().product();
            let given = self.entries_of(clause, integral, tree)?;
            Ok(given.unwrap_or_else(|| vec![zero; count]))
        };
        let triples = |integral: Integral| -> Result<Vec<Triple<'g>>> {
            Ok(entries(integral)?.chunks(3).map(|row| [row[0], row[1], row[2]]).collect())
        };
        let tensors = |integral: Integral| -> Result<Vec<[Triple<'g>; 3]>> {
            Ok(entries(integral)?.chunks(6).map(|row| PAIRS.map(|line| line.map(|at| row[at]))).collect())
        };
        Ok(ModalIntegrals {
            translation: triples(Integral::Translation)?,
            rotation: triples(Integral::Rotation)?,
            mass: self.matrix_of(clause, Integral::Mass, tree)?.unwrap_or_else(unit),
            inertia: tensors(Integral::Inertia)?,
            shortening: in_rows(triples(Integral::Shortening)?, n),
            gyroscopic: in_rows(triples(Integral::Gyroscopic)?, n),
            second_inertia: in_rows(tensors(Integral::SecondInertia)?, n),
        })
    }

    /// The entries of an integral; of one that is symmetric in its modes the mean of both where they are numbers.
    fn entries_of(&self, clause: &ModesClause, integral: Integral, tree: &Tree<'g>) -> Result<Option<Vec<Expr<'g>>>> {
        let Some(given) = clause.find(integral) else { return Ok(None) };
        let entries: Vec<Expr<'g>> = given.entries.iter().map(|e| self.scalar(e, tree)).collect::<Result<_>>()?;
        if !integral.is_symmetric() {
            return Ok(Some(entries));
        }
        let n = clause.coordinates.len();
        let size = entries.len() / (n * n).max(1);
        let exchanged = |at: usize| {
            let (pair, within) = (at / size, at % size);
            entries[((pair % n) * n + pair / n) * size + within]
        };
        let mut unequal = false;
        let mean = |(at, &entry): (usize, &Expr<'g>)| {
            let other = exchanged(at);
            unequal |= entry != other && (self.known(entry).is_none() || self.known(other).is_none());
            if entry == other { entry } else { (entry + other).half() }
        };
        let symmetric = entries.iter().enumerate().map(mean).collect();
        if unequal {
            let word = integral.word();
            self.mistake(
                given.span,
                format!("`{word}` is symmetric in its modes: write the same expression for [k][l] and [l][k]"),
            );
        }
        Ok(Some(symmetric))
    }

    fn matrix_of(
        &self,
        clause: &ModesClause,
        integral: Integral,
        tree: &Tree<'g>,
    ) -> Result<Option<Vec<Vec<Expr<'g>>>>> {
        let Some(entries) = self.entries_of(clause, integral, tree)? else { return Ok(None) };
        let law = match integral {
            Integral::Stiffness => Some(LawKind::StiffnessMatrix),
            Integral::Damping => Some(LawKind::DampingMatrix),
            _ => None,
        };
        // Numbers are judged where they are written.
        if let Some(kind) = law.filter(|_| entries.iter().any(|e| self.known(*e).is_none())) {
            let label = format!("{}.{}", clause.body.unraw(), integral.word());
            self.notes.add().laws.push(Law { label, kind, values: entries.clone() });
        }
        Ok(Some(in_rows(entries, clause.coordinates.len())))
    }

    /// Notes the check that the modes take no more of the mass than the body has, unless all of it is numbers.
    fn note_whole(&self, clause: &ModesClause, (etas, matrix): (&[Expr<'g>], &[Vec<Expr<'g>>]), link: &Link<'g>) {
        let zero = self.graph.zero();
        let Some(body) = link.body() else { return };
        let still = etas.iter().map(|eta| (eta.key(), zero)).collect();
        let mut whole: Vec<Vec<Expr<'g>>> =
            matrix.iter().map(|row| row.iter().map(|e| e.substitute(&still)).collect()).collect();
        let first = body.first_moment();
        for i in 0..3 {
            whole[i][i] = body.mass;
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            for (row, column, value) in [(i, 3 + j, first[k]), (i, 3 + k, -first[j])] {
                (whole[row][column], whole[column][row]) = (value, value);
            }
            (0..3).for_each(|j| whole[3 + i][3 + j] = body.inertia[i][j]);
        }
        let values = whole.concat();
        if values.iter().any(|e| self.known(*e).is_none()) {
            let label = clause.body.unraw().to_string();
            self.notes.add().laws.push(Law { label, kind: LawKind::Modes, values });
        }
    }
}

fn in_rows<T>(entries: Vec<T>, n: usize) -> Vec<Vec<T>> {
    let mut entries = entries.into_iter();
    (0..n).map(|_| entries.by_ref().take(n).collect()).collect()
}

/// ½ xᵀKx of a symmetric K.
fn half_form<'g>(matrix: &[Vec<Expr<'g>>], x: &[Expr<'g>]) -> Expr<'g> {
    let mut form = x[0].graph().zero();
    for (i, row) in matrix.iter().enumerate() {
        form = form + (row[i] * x[i].powi(2)).half();
        form = (i + 1..x.len()).fold(form, |form, j| form + row[j] * x[i] * x[j]);
    }
    form
}
