//! Methods that were chosen by name, in lanes.

use gauss_runtime::integrate::problem::equations::Problem;
use gauss_runtime::integrate::problem::error::IntegrationErrorKind;
use gauss_runtime::integrate::{Adams, Adaptive, EstimatingStep, Fixed, MethodControl, MethodPair, MethodStep};

use super::{BatchSystem, Group, LaneControl, Sealed, Verdict};

impl<T, R, P> Sealed for MethodControl<T, R, P> {}

/// Forwards all to the control that is chosen, which is in the memory with its own.
macro_rules! forward {
    ($($kind:ident: $type:ty;)+) => {
        /// The memory of lanes, with the control that remembers it.
        #[doc(hidden)]
        pub enum MethodLanes<S: BatchSystem, R: EstimatingStep<S>, C: LaneControl<S>> {
            $($kind($type, <$type as LaneControl<S>>::Memory),)+
        }

        impl<S: BatchSystem, R, C> LaneControl<S> for MethodControl<S::Scalar, R, C>
        where
            R: EstimatingStep<S> + Copy,
            C: LaneControl<S> + Copy,
        {
            type Memory = MethodLanes<S, R, C>;

            fn paced(&self) -> bool {
                match self {
                    $(Self::$kind(control) => LaneControl::<S>::paced(control),)+
                }
            }

            fn memory(&self, span: f64, limit: u64) -> Result<Self::Memory, IntegrationErrorKind> {
                match *self {
                    $(Self::$kind(control) => Ok(MethodLanes::$kind(control, control.memory(span, limit)?)),)+
                }
            }

            fn begin<P: Problem<System = S>>(
                &self,
                problem: &P,
                group: &Group<S>,
                lane: (usize, u64),
                memory: &mut Self::Memory,
            ) -> Result<(), IntegrationErrorKind> {
                match memory {
                    $(MethodLanes::$kind(control, memory) => control.begin(problem, group, lane, memory),)+
                }
            }

            fn attempt<P: Problem<System = S>>(
                &self,
                problem: &P,
                group: &mut Group<S>,
                who: &[bool],
                memory: &mut Self::Memory,
            ) -> Result<(), IntegrationErrorKind> {
                match memory {
                    $(MethodLanes::$kind(control, memory) => control.attempt(problem, group, who, memory),)+
                }
            }

            fn failed<P: Problem<System = S>>(
                &self,
                at: (&P, &Group<S>),
                lane: usize,
                kind: IntegrationErrorKind,
                memory: &mut Self::Memory,
            ) -> Verdict {
                match memory {
                    $(MethodLanes::$kind(control, memory) => control.failed(at, lane, kind, memory),)+
                }
            }

            fn length(&self, lane: usize, memory: &Self::Memory) -> f64 {
                match memory {
                    $(MethodLanes::$kind(control, memory) => LaneControl::<S>::length(control, lane, memory),)+
                }
            }

            fn passes_over_decay(&self) -> bool {
                match self {
                    $(Self::$kind(control) => LaneControl::<S>::passes_over_decay(control),)+
                }
            }
        }
    };
}

forward! {
    Fixed: Fixed<S::Scalar, MethodStep<R>>;
    Adaptive: Adaptive<MethodPair<R>>;
    Adams10: Adams<S::Scalar, 10>;
    Adams12: Adams<S::Scalar, 12>;
    Taylor: C;
}
