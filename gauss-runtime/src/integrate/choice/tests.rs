//! Names of methods, and what the table says of each.

use std::collections::BTreeSet;
use std::string::ToString;

use super::control::StepSetting;
use super::error::{MethodError, UnknownMethod};
use super::method::Method;
use super::step::{Absent, MethodStep};
use crate::integrate::{EstimatingStep, JacobianMethod, MethodControl, MethodPair, OneStep, Taylor};
use crate::testing::FreeTop;

type AnyKernelControl = MethodControl<f64>;
type Full = MethodControl<f64, JacobianMethod, Taylor>;

#[test]
fn names_are_read_as_they_are_written() {
    for &method in Method::ALL {
        assert_eq!(method.to_string().parse(), Ok(method));
        assert!(
            method
                .name()
                .bytes()
                .all(|letter| letter == b'_' || letter.is_ascii_lowercase() || letter.is_ascii_digit())
        );
    }
    let names: BTreeSet<_> = Method::ALL.iter().map(|method| method.name()).collect();
    assert_eq!(names.len(), Method::ALL.len());
}

#[test]
fn other_names_are_told_of_those_that_there_are() {
    let nearest = |name: &str| name.parse::<Method>().expect_err("no method").nearest;
    // Names of other programs, in any letters; letters that are wrong, missing or too many.
    for (name, meant) in [
        ("dop853", Method::DormandPrince8),
        ("DOP853", Method::DormandPrince8),
        ("RK45", Method::DormandPrince5),
        ("rk4", Method::Classical4),
        ("Radau5", Method::Radau),
        ("dormand_price", Method::DormandPrince8),
        ("dormand-prince-5", Method::DormandPrince5),
        ("Verner_9", Method::Verner9),
        ("tailor", Method::Taylor),
        ("colocation", Method::Collocation6),
        ("adams_11", Method::Adams10),
    ] {
        assert_eq!(nearest(name), Some(meant), "{name}");
    }
    for name in ["", "x", "leapfrog", "no method has a name with so many letters, and none is like it"] {
        assert_eq!(nearest(name), None, "{name}");
    }
    let told = UnknownMethod { nearest: Some(Method::Verner9) }.to_string();
    assert!(told.starts_with("no such method; there are dormand_prince, dormand_prince_5, "), "{told}");
    assert!(told.ends_with("taylor; is verner_9 meant?"), "{told}");
    assert!(Method::ALL.iter().all(|method| told.contains(method.name())), "{told}");
}

/// Orders are those that methods state of themselves, and controls are made of whatever the table says.
#[test]
fn the_table_says_what_methods_say() {
    for &method in Method::ALL {
        if let Some(step) = MethodStep::<Absent>::of(method) {
            assert_eq!(method.order(), Some(OneStep::<FreeTop<f64>>::properties(&step).order), "{method}");
        }
        let pair = MethodPair::<Absent>::of(method);
        if let Some(pair) = pair {
            // Estimates are of an order less, or of the same one where there are two of them.
            let order = EstimatingStep::<FreeTop<f64>>::estimate_order(&pair);
            assert!(method.order().is_some_and(|of| (0.0..=1.0).contains(&(f64::from(of) - order))), "{method}");
        }
        let equal = AnyKernelControl::new(method, StepSetting::Equal(0.1)).map(drop);
        let tolerant = AnyKernelControl::new(method, StepSetting::tolerant(1e-9, 1e-9)).map(drop);
        let lacks = method.clause().map_or(Ok(()), |clause| Err(MethodError::Clause(method, clause)));
        assert_eq!(equal, if method.takes_length() { lacks } else { Err(MethodError::NoLength(method)) });
        assert_eq!(tolerant, if method.keeps_tolerances() { lacks } else { Err(MethodError::NoEstimate(method)) });
        assert_eq!(Full::new(method, StepSetting::Equal(0.1)).is_ok(), method.takes_length());
        assert_eq!(Full::new(method, StepSetting::tolerant(1e-9, 1e-9)).is_ok(), method.keeps_tolerances());
    }
}
