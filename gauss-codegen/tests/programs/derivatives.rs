//! Programs of derivatives: forward beside dual numbers through the program itself, backward beside forward.

use gauss_codegen::program::{ArgumentKind, Program, SparseJacobian};

use super::{Dual, dual};
use crate::common::{Random, SCENES, derivation, random_arguments};

/// A Jacobian with its zeros, an output a row and a component a column.
struct Dense {
    rows: Vec<Vec<f64>>,
}

impl Dense {
    fn of(program: &Program, jacobian: &SparseJacobian, arguments: &[&[f64]]) -> Self {
        let entries = jacobian.program.run(arguments).expect("its arguments");
        let width = |count: usize| program.arguments[..count].iter().map(|own| own.components.len()).sum::<usize>();
        let height = |count: usize| program.results[..count].iter().map(|own| own.len()).sum::<usize>();
        let mut rows = vec![vec![0.0; width(program.arguments.len())]; program.code.outputs.len()];
        let mut entries = entries.into_iter();
        for (k, places) in jacobian.places.iter().enumerate() {
            let (result, argument) = (k / program.arguments.len(), k % program.arguments.len());
            for (row, column) in places {
                rows[height(result) + row][width(argument) + column] = entries.next().expect("an entry");
            }
        }
        assert!(entries.next().is_none());
        Self { rows }
    }

    /// What rounding may do to entries of this size, some thousand times over.
    fn allowed(&self) -> f64 {
        let finite = self.rows.iter().flatten().filter(|entry| entry.is_finite());
        1e-11 * (1.0 + finite.fold(0.0_f64, |most, entry| most.max(entry.abs())))
    }
}

/// The same by dual numbers, column by column.
fn by_dual_numbers(program: &Program, arguments: &[&[f64]]) -> Vec<Vec<f64>> {
    let places = arguments.iter().enumerate().flat_map(|(k, list)| (0..list.len()).map(move |i| (k, i)));
    let column = |place: (usize, usize)| -> Vec<f64> {
        let seeded = |(k, list): (usize, &&[f64])| -> Vec<Dual> {
            let slope = |i| f64::from(u8::from((k, i) == place));
            list.iter().enumerate().map(|(i, value)| dual(*value, slope(i))).collect()
        };
        let duals: Vec<Vec<Dual>> = arguments.iter().enumerate().map(seeded).collect();
        let duals: Vec<&[Dual]> = duals.iter().map(Vec::as_slice).collect();
        program.run(&duals).expect("its arguments").iter().map(|output| output.slope).collect()
    };
    places.map(column).collect()
}

#[test]
fn jacobians_and_adjoints_are_those_of_dual_numbers() {
    let (mut compared, mut all) = (0, 0);
    for (name, _) in SCENES {
        let derivation = derivation(name);
        for program in derivation.programs() {
            let program = &program.of_parameters(derivation.constants()).expect("of right shape");
            let arguments = random_arguments(&derivation, program, &mut Random(7));
            let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
            let jacobian = Dense::of(program, &program.jacobian("jacobian").expect("of right shape"), &lists);
            let allowed = jacobian.allowed();
            for (j, column) in by_dual_numbers(program, &lists).into_iter().enumerate() {
                for (i, wanted) in column.into_iter().enumerate() {
                    let found = jacobian.rows[i][j];
                    all += 1;
                    compared += usize::from(wanted.is_finite());
                    // Of a power of a negative number dual numbers know nothing.
                    let same = !wanted.is_finite() || (found - wanted).abs() <= allowed;
                    assert!(same, "{name}, {}: row {i}, column {j}: {found} and {wanted}", program.name);
                }
            }
            let mut random = Random(3);
            let weights: Vec<Vec<f64>> =
                program.results.iter().map(|own| (0..own.len()).map(|_| random.number()).collect()).collect();
            let mut with_weights = lists.clone();
            with_weights.extend(weights.iter().map(Vec::as_slice));
            let adjoint =
                program.adjoint("adjoint").expect("of right shape").run(&with_weights).expect("its arguments");
            let weights: Vec<f64> = weights.into_iter().flatten().collect();
            for (j, found) in adjoint.into_iter().enumerate() {
                let wanted: f64 = weights.iter().zip(&jacobian.rows).map(|(weight, row)| weight * row[j]).sum();
                let bound = allowed * (1.0 + weights.iter().map(|weight| weight.abs()).sum::<f64>());
                assert!(
                    !wanted.is_finite() || (found - wanted).abs() <= bound,
                    "{name}, {}: {found} {wanted}",
                    program.name
                );
            }
        }
    }
    assert!(compared * 10 > all * 9, "{compared} of {all}");
}

#[test]
fn tangents_are_jacobians_times_directions() {
    for name in ["Top", "Arms"] {
        let derivation = derivation(name);
        let program = derivation.program("acceleration").expect("derived");
        let arguments = random_arguments(&derivation, program, &mut Random(5));
        let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let jacobian = Dense::of(program, &program.jacobian("jacobian").expect("of right shape"), &lists);
        let kinds = [ArgumentKind::Configuration, ArgumentKind::Speeds];
        let mut random = Random(9);
        let moves = |kind| kinds.contains(&kind);
        let along: Vec<Vec<f64>> = program
            .arguments
            .iter()
            .map(|own| own.components.iter().map(|_| if moves(own.kind) { random.number() } else { 0.0 }).collect())
            .collect();
        let mut with_directions = lists.clone();
        with_directions
            .extend(program.arguments.iter().zip(&along).filter(|(own, _)| moves(own.kind)).map(|(_, d)| &d[..]));
        let tangent = program.tangent("tangent", &kinds).expect("of right shape");
        let along: Vec<f64> = along.iter().flatten().copied().collect();
        for (row, found) in jacobian.rows.iter().zip(tangent.run(&with_directions).expect("its arguments")) {
            let wanted: f64 = row.iter().zip(&along).map(|(entry, d)| entry * d).sum();
            assert!((found - wanted).abs() <= 10.0 * jacobian.allowed(), "{name}: {found} {wanted}");
        }
    }
}

/// The Jacobian of a gradient is symmetric: by no rule of either.
#[test]
fn hessians_of_sums_are_symmetric() {
    for name in ["Top", "Gyroscope", "Arms"] {
        let derivation = derivation(name);
        let program = derivation.program("acceleration").expect("derived");
        let program = program.of_parameters(derivation.constants()).expect("of right shape");
        let adjoint = program.adjoint("adjoint").expect("of right shape");
        let arguments = random_arguments(&derivation, &adjoint, &mut Random(5));
        let lists: Vec<&[f64]> = arguments.iter().map(Vec::as_slice).collect();
        let hessian = Dense::of(&adjoint, &adjoint.jacobian("hessian").expect("of right shape"), &lists);
        let allowed = 10.0 * hessian.allowed();
        let mut size = 0.0_f64;
        for (i, row) in hessian.rows.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate().take(i) {
                size = size.max(entry.abs());
                let mirrored = hessian.rows[j][i];
                assert!((entry - mirrored).abs() <= allowed, "{name}: {i} {j}: {entry} {mirrored}");
            }
        }
        assert!(size > 0.1, "{name}: nothing was compared");
    }
}

#[test]
fn methods_that_are_not_there_are_all_named() {
    let functions = derivation("Top").functions().clone();
    let wanted = ["acceleration", "nonsense", "bogus"].map(String::from);
    let error = functions.only(&wanted).expect_err("two of them are none").to_string();
    assert!(error.starts_with("Top has no method `nonsense`, `bogus`; it has "), "{error}");
    let only = functions.only(&wanted[..1]).expect("it is there");
    assert_eq!(only.methods.iter().map(|program| program.name.as_str()).collect::<Vec<_>>(), ["acceleration"]);
    assert_eq!(functions.only(&[]).expect("all"), functions);
}
