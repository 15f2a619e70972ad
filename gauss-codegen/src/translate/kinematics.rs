//! ψ, and the rates of everything that it moves.

use crate::algebra::{Expr, Map};
use crate::error::Result;
use crate::mechanics::{ChartedBody, Coordinate, Tree, poisson};
use crate::model::{self, BinaryOperator, ExpressionKind, FunctionName, Property};
use crate::words::Unraw;

use super::translator::{ObservedRates, Translator, bug};
use super::value::Value;

impl<'g> Translator<'_, 'g> {
    /// ψ, in the order of the coordinates, with zero for the states of elements; ḃ and ω̂ of each that is a pose or a
    /// rotation, where the kinematics give them rather than u and ω.
    pub(super) fn kinematics(&self) -> Result<(Vec<Expr<'g>>, Vec<ObservedRates<'g>>)> {
        let mut rates = self.chart().map(ChartedBody::coordinate_rates).unwrap_or_default();
        let mut observed = vec![[None; 2]; self.model.coordinates.len()];
        let still = self.declared.states.clone().map(|_| self.graph.zero());
        let of_let_go = self.let_go.iter().flat_map(|by| by.speeds.iter().copied());
        if self.model.speeds.is_none() {
            let own = &self.declared.speeds[self.speeds_of_chart()..];
            rates.extend(&own[..own.len() - of_let_go.clone().count()]);
            rates.extend(still.chain(of_let_go));
            return Ok((rates, observed));
        }
        let nothing = self.no_links();
        for (k, (_, e)) in self.model.kinematics.iter().enumerate() {
            observed[k] = self.observed_rates_of(k, e, &nothing)?;
            match self.value(e, &nothing)?.observed() {
                Value::Scalar(rate) => rates.push(rate),
                Value::Vector(omega) => rates.extend(omega),
                Value::Twist(linear, angular) => rates.extend(linear.into_iter().chain(angular)),
                _ => return Err(bug(e.span)),
            }
        }
        rates.extend(still.chain(of_let_go));
        Ok((rates, observed))
    }

    /// Puts the rates of states in their places in ψ and among the rates of symbols: they may name all that forces may,
    /// so the links come first, and no link is moved by a state.
    pub(super) fn move_states(&mut self, tree: &Tree<'g>) -> Result<()> {
        let states = self.declared.states.clone();
        let first: usize = self.declared.coordinates[..states.start].iter().map(Coordinate::size).sum();
        for (k, (state, coordinate)) in self.model.states.iter().zip(&self.declared.coordinates[states]).enumerate() {
            let Some(rate) = self.graph.defined(|| self.scalar(&state.rate, tree)) else {
                self.divides_by_zero(state.rate.span, &state.ident.to_string());
                continue;
            };
            let Coordinate::Scalar(symbol) = coordinate else { return Err(bug(state.rate.span)) };
            self.kinematics[first + k] = rate?;
            self.rates.insert(symbol.key(), self.kinematics[first + k]);
        }
        Ok(())
    }

    /// v and w of `twist(inverse(pose.rotation) * v, inverse(pose.rotation) * w)`, and w of `inverse(rotation) * w`:
    /// turned back into observer's axes they are what they were.
    fn observed_rates_of(
        &self,
        coordinate: usize,
        rate: &model::Expression,
        nothing: &Tree<'g>,
    ) -> Result<ObservedRates<'g>> {
        let own = &self.model.coordinates[coordinate].ident;
        let turned_back = |e: &model::Expression| -> Result<Option<[Expr<'g>; 3]>> {
            let ExpressionKind::Binary(BinaryOperator::Multiply, turned, v) = &e.kind else { return Ok(None) };
            let ExpressionKind::Call(FunctionName::Inverse, rotation) = &turned.kind else { return Ok(None) };
            let Some(rotation) = rotation.first() else { return Ok(None) };
            let of_pose = name_of_property(rotation, Property::Rotation);
            let itself = matches!(&rotation.kind, ExpressionKind::Name(name) if name.unraw() == own.unraw());
            if itself || of_pose.is_some_and(|pose| own.unraw() == pose) {
                self.vector(v, nothing).map(Some)
            } else {
                Ok(None)
            }
        };
        match &rate.kind {
            ExpressionKind::Call(FunctionName::Twist, parts) => match parts.as_slice() {
                [linear, angular] => Ok([turned_back(linear)?, turned_back(angular)?]),
                _ => Ok([None; 2]),
            },
            _ => Ok([None, turned_back(rate)?]),
        }
    }

    /// Rates of t and of the symbols of q: Ṙ = R [ω]× (Poisson), ḃ = R u.
    pub(super) fn rates(&self) -> Map<u32, Expr<'g>> {
        let mut rates: Map<u32, Expr<'g>> = Map::from_iter([(self.declared.time.key(), self.graph.one())]);
        rates.extend(
            self.chart().into_iter().flat_map(|chart| chart.kinematics.rates.iter()).map(|(&key, &rate)| (key, rate)),
        );
        let own = || self.declared.coordinates.iter().enumerate().skip(self.declared.before);
        for (k, coordinate) in own() {
            let rate = self.declared.rate_of(k, &self.kinematics);
            if let (Some(matrix), &[.., w1, w2, w3]) = (coordinate.rotation(), rate) {
                rates.extend(poisson(matrix, &[w1, w2, w3]));
            }
        }
        for (k, coordinate) in own() {
            let rate = self.declared.rate_of(k, &self.kinematics);
            match coordinate {
                Coordinate::Scalar(q) => {
                    rates.insert(q.key(), rate[0]);
                }
                // Of planes the chart's own rates are known.
                Coordinate::Rotation(_) | Coordinate::Plane { .. } => {}
                Coordinate::Pose(matrix, position) => {
                    for (i, (row, b)) in matrix.iter().zip(position).enumerate() {
                        let turned = || (0..3).map(|k| row[k] * rate[k]).sum();
                        let [observed, _] = self.observed_rates[k - self.declared.before];
                        rates.insert(b.key(), observed.map_or_else(turned, |v| v[i]));
                    }
                }
            }
        }
        rates
    }
}

/// The name of `name.property`.
pub(super) fn name_of_property(e: &model::Expression, wanted: Property) -> Option<String> {
    match &e.kind {
        ExpressionKind::Property(inner, property) if *property == wanted => match &inner.kind {
            ExpressionKind::Name(name) => Some(name.unraw().to_string()),
            _ => None,
        },
        _ => None,
    }
}
