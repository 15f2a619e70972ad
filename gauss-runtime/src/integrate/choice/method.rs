//! The table of all methods that can be chosen by name: a row makes a method one of them, for runs, lanes,
//! sensitivities, Python and the report of speed against error.

use core::fmt;
use core::str::FromStr;

use crate::integrate::choice::error::UnknownMethod;

/// Calls a macro with the rows of the table:
///
/// `Variant "name" order "clause that it needs" [names elsewhere] explicit|implicit: value => type;`
///
/// Pairs estimate their errors, and so do those with Jacobians, which need a place in the control; singles, which are
/// written without their type, make steps of one length alone. Multisteps are controls of such steps, made from the
/// length, and series are controls that choose their steps, made from two tolerances and the longest step. In types `T`
/// is the scalar; `R` and `P` are [`JacobianMethod`] and [`Taylor`] where a control has a place for them.
///
/// [`JacobianMethod`]: crate::integrate::JacobianMethod
/// [`Taylor`]: crate::integrate::Taylor
macro_rules! with_methods {
    ($macro:ident) => {
        $macro! {
            pairs {
                /// Dormand and Prince's method of order 8 with estimates of orders 5 and 3; the default.
                DormandPrince8 "dormand_prince" 8 "" ["dop853", "dopri8", "rk8", "dormand_prince_8", "tsit5"] explicit:
                    Some(RungeKutta(DormandPrince8)) => RungeKutta<DormandPrince8, 12>;
                /// Dormand and Prince's pair of orders 5 and 4.
                DormandPrince5 "dormand_prince_5" 5 "" ["dopri5", "rk45", "ode45", "rkf45", "dopri"] explicit:
                    Some(RungeKutta(DormandPrince5)) => RungeKutta<DormandPrince5, 7>;
                /// Verner's pair of orders 9 and 8.
                Verner9 "verner_9" 9 "" ["vern9", "ode89", "rk9", "vern7"] explicit:
                    Some(RungeKutta(Verner9)) => RungeKutta<Verner9, 16>;
            }
            jacobians {
                /// Rosenbrock's method RODAS, linearly implicit, for stiff scenes.
                Rosenbrock "rosenbrock" 4 "linearize" ["rodas", "ode23s", "ros4"] implicit: Rosenbrock => Rosenbrock;
                /// Radau's method IIA of order 5, implicit, for stiff scenes.
                Radau "radau" 5 "linearize"
                    ["radau5", "radau_iia", "bdf", "lsoda", "cvode", "ode15s", "implicit", "generalized_alpha"]
                    implicit: crate::integrate::Radau => crate::integrate::Radau;
            }
            singles {
                /// Gauss' collocation of order 6, implicit, symmetric and symplectic.
                Collocation6 "collocation" 6 "" ["gauss", "gauss_legendre", "gl6", "symplectic", "collocation_6"]
                    implicit: Collocation::order_6();
                /// Gauss' collocation of order 4.
                Collocation4 "collocation_4" 4 "" ["gl4"] implicit: Collocation::order_4();
                /// Gauss' collocation of order 2: the implicit midpoint rule.
                Collocation2 "collocation_2" 2 "" ["midpoint", "implicit_midpoint", "gl2"] implicit:
                    Collocation::midpoint();
                /// Runge and Kutta's classical method of order 4.
                Classical4 "runge_kutta_4" 4 "" ["rk4", "rk", "runge_kutta", "euler"] explicit:
                    RungeKutta(Classical4);
                /// Celledoni, Marthinsen and Owren's commutator-free method of order 4 on the group.
                CommutatorFree4 "commutator_free_4" 4 "" ["cf4", "rkmk4", "munthe_kaas"] explicit: CommutatorFree4;
            }
            multisteps {
                /// Adams' method of ten steps: two evaluations a step.
                Adams10 "adams_10" 9 "" ["adams", "abm", "vode", "ode113"] explicit: Adams::new => Adams<T, 10>;
                /// Adams' method of twelve steps.
                Adams12 "adams_12" 9 "" ["vcabm"] explicit: Adams::new => Adams<T, 12>;
            }
            series {
                /// Power series of the solution, of an order that follows from the tolerance.
                Taylor "taylor" 0 "taylor" ["heyoka", "series", "power_series"] explicit:
                    |relative, absolute, largest_step| {
                        P::put(Taylor { relative, absolute, order: None, largest_step })
                    } => P;
            }
        }
    };
}
pub(super) use with_methods;

macro_rules! method {
    ($($kind:ident {
        $(
            $(#[$about:meta])+ $method:ident $name:literal $order:literal $clause:literal [$($word:literal),*]
                $explicit:ident: $value:expr $(=> $type:ty)?;
        )+
    })+) => {
        /// A method by name, to be chosen when a program runs: [`control`](Self::control) makes what a run takes.
        ///
        /// ```
        /// use gauss_runtime::integrate::{Method, UnknownMethod};
        ///
        /// assert_eq!("verner_9".parse(), Ok(Method::Verner9));
        /// let error: UnknownMethod = "dop853".parse::<Method>().expect_err("that is a name of other programs");
        /// assert_eq!(error.nearest, Some(Method::DormandPrince8));
        /// assert!(error.to_string().ends_with("is dormand_prince meant?"));
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Method {
            $($($(#[$about])+ $method,)+)+
        }

        impl Method {
            /// All of them.
            pub const ALL: &'static [Self] = &[$($(Self::$method,)+)+];

            /// Its row: name, order, clause, names elsewhere, and the two words for what it is.
            const fn row(self) -> (&'static str, u32, &'static str, &'static [&'static str], [&'static str; 2]) {
                match self {
                    $($(Self::$method => {
                        ($name, $order, $clause, &[$($word),*], [stringify!($kind), stringify!($explicit)])
                    })+)+
                }
            }
        }
    };
}

with_methods!(method);

impl Method {
    /// The name by which it is chosen.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.row().0
    }

    /// Its order; none where it follows from the tolerance.
    #[must_use]
    pub fn order(self) -> Option<u32> {
        Some(self.row().1).filter(|&order| order > 0)
    }

    /// The clause that a struct says for it, where it needs more of a system than its accelerations: power series, or
    /// derivatives.
    #[must_use]
    pub fn clause(self) -> Option<&'static str> {
        Some(self.row().2).filter(|clause| !clause.is_empty())
    }

    /// Whether its steps are as long as tolerances allow, if so wanted.
    #[must_use]
    pub fn keeps_tolerances(self) -> bool {
        matches!(self.row().4[0], "pairs" | "jacobians" | "series")
    }

    /// Whether its steps are of one length, if so wanted.
    #[must_use]
    pub fn takes_length(self) -> bool {
        self.row().4[0] != "series"
    }

    /// Whether it is an explicit method of one step, with derivatives of runs.
    #[must_use]
    pub fn is_explicit_step(self) -> bool {
        matches!(self.row().4, ["pairs" | "singles", "explicit"])
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let all = || Method::ALL.iter().copied();
        let elsewhere = |method: &Self| method.row().3.iter().any(|word| word.eq_ignore_ascii_case(name));
        // A third of its letters wrong is another word.
        let distance = |method: &Self| edits(method.name(), name);
        let near = || all().filter(|method| 3 * distance(method) <= method.name().len()).min_by_key(distance);
        all()
            .find(|method| method.name() == name)
            .ok_or_else(|| UnknownMethod { nearest: all().find(elsewhere).or_else(near) })
    }
}

/// The longest name that is compared letter by letter.
const LONGEST: usize = 24;

/// Number of letters to put in, leave out or replace in one word for the other (Levenshtein).
fn edits(name: &str, other: &str) -> usize {
    if other.len() > LONGEST {
        return usize::MAX / 4;
    }
    let mut row: [usize; LONGEST + 1] = core::array::from_fn(|i| i);
    for (i, a) in name.bytes().enumerate() {
        let mut diagonal = core::mem::replace(&mut row[0], i + 1);
        for (j, b) in other.bytes().enumerate() {
            let replaced = diagonal + usize::from(!a.eq_ignore_ascii_case(&b));
            let least = replaced.min(row[j] + 1).min(row[j + 1] + 1);
            diagonal = core::mem::replace(&mut row[j + 1], least);
        }
    }
    row[other.len()]
}
