//! Elements by name, and their sums against the equations of motion.

use nalgebra::{SMatrix, SVector};
use std::string::ToString;

use super::*;
use crate::testing::oscillator::{Oscillator, Viscous};

type System = Oscillator<Viscous>;

/// A state of no symmetry: t, q, z, input.
fn state() -> (f64, SVector<f64, 1>, SVector<f64, 1>, f64) {
    (0.5, SVector::from([1.25]), SVector::from([-0.75]), 0.375)
}

#[test]
fn elements_are_found_by_name() {
    let (system, (t, q, z, input)) = (System::new(0.5), state());
    let powers = system.powers(t, &q, &z, &input);
    for (n, element) in System::ELEMENTS.iter().enumerate() {
        assert_eq!(system.power(element.name, t, &q, &z, &input), Some(powers[n]));
        let force = system.generalised_force(element.name, t, &q, &z, &input).expect("an element");
        // One speed, and it is the velocity of what is acted on.
        assert_eq!(force[0] * z[0], powers[n], "{element}");
    }
    assert_eq!(system.power("wind", t, &q, &z, &input), None);
    assert_eq!(system.generalised_force("wind", t, &q, &z, &input), None);
}

#[test]
fn columns_of_a_matrix() {
    let matrix = SMatrix::<f64, 2, 3>::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
    let columns: [Option<SVector<f64, 2>>; 4] = core::array::from_fn(|n| matrix.nth(n));
    let expected = [[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]].map(|column| Some(SVector::from(column)));
    assert_eq!(columns, [expected[0], expected[1], expected[2], None]);
    // Generated code makes rectangular matrices row by row.
    assert_eq!(crate::private::matrix([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]), matrix);
}

#[test]
fn elements_print_where_their_work_is_counted() {
    assert_eq!(Element::new("spring", true).to_string(), "spring (in the potential energy)");
    assert_eq!(Element::new("drag", false).to_string(), "drag");
}
