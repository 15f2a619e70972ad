//! Derived structs by the dozen: one macro a scene, which chart and motion fill in.
//!
//! The names of the fields are methods of [`Parameters`](super::parameters::Parameters).

/// A derived struct and its [`Scene`](super::body::Scene).
macro_rules! scene {
    ($name:ident $kernel:ident, $motion:ident, [$($chart:tt)+], { $($role:ident $field:ident: $type:ty),+ }) => {
        #[derive(::gauss_runtime::GaussDynamics)]
        #[gauss(chart = $($chart)+, motion = $motion)]
        pub struct $name<T> { $(#[gauss($role)] $field: $type),+ }

        impl $crate::common::body::Scene for $name<()> {
            type Kernel<T: ::gauss_runtime::prelude::Real> = $kernel<T>;
            fn kernel<T: ::gauss_runtime::prelude::Real>(
                parameters: &$crate::common::parameters::Parameters,
            ) -> Self::Kernel<T> {
                $name { $($field: parameters.$field()),+ }.kernel().expect("random bodies are physical")
            }
        }
    };
}

/// Spherical inertia, O = G.
macro_rules! spherical {
    ($($head:tt)+) => { scene!($($head)+, { mass mass: T, inertia spherical: T }); };
}

/// Principal axes, O = G: the textbook body.
macro_rules! principal {
    ($($head:tt)+) => { scene!($($head)+, { mass mass: T, inertia principal: ::gauss_runtime::prelude::Vector3<T> }); };
}

/// Full inertia about O ≠ G, gravity along −k₃.
macro_rules! heavy {
    ($($head:tt)+) => {
        scene!($($head)+, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia inertia: ::gauss_runtime::prelude::Matrix3<T>, gravity g: T
        });
    };
}

/// Principal axes about O ≠ G, diagonal added mass.
macro_rules! torpedo {
    ($($head:tt)+) => {
        scene!($($head)+, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia principal: ::gauss_runtime::prelude::Vector3<T>,
            added_mass diagonal_fluid: ::gauss_runtime::prelude::Vector6<T>
        });
    };
}

/// Every feature at once, each in its most general form.
macro_rules! everything {
    ($($head:tt)+) => {
        scene!($($head)+, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia inertia: ::gauss_runtime::prelude::Matrix3<T>,
            added_mass fluid: ::gauss_runtime::prelude::Matrix6<T>,
            gravity field: ::gauss_runtime::prelude::Vector3<T>,
            displaced_mass displaced: T,
            center_of_buoyancy buoyancy: ::gauss_runtime::prelude::Vector3<T>
        });
    };
}

/// Full inertia about O ≠ G, full added mass, no forces.
macro_rules! adrift {
    ($($head:tt)+) => {
        scene!($($head)+, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia inertia: ::gauss_runtime::prelude::Matrix3<T>,
            added_mass fluid: ::gauss_runtime::prelude::Matrix6<T>
        });
    };
}

/// Buoyancy at O, vertical gravity, diagonal added mass.
macro_rules! afloat {
    ($($head:tt)+) => {
        scene!($($head)+, {
            mass mass: T, center_of_mass center: ::gauss_runtime::prelude::Vector3<T>,
            inertia principal: ::gauss_runtime::prelude::Vector3<T>,
            added_mass diagonal_fluid: ::gauss_runtime::prelude::Vector6<T>,
            gravity g: T, displaced_mass displaced: T
        });
    };
}

/// The scene in the charts that most checks look at.
macro_rules! usual_charts {
    ($scene:ident, $motion:ident) => {
        $scene!(Left LeftKernel, $motion, [left_invariant]);
        $scene!(Right RightKernel, $motion, [right_invariant]);
        $scene!(Hybrid HybridKernel, $motion, [hybrid]);
        $scene!(Zyx ZyxKernel, $motion, [jet(euler_zyx)]);
        $scene!(Zxz ZxzKernel, $motion, [jet(euler_zxz)]);
        $scene!(Modified ModifiedKernel, $motion, [jet(modified_rodrigues)]);
    };
}

/// The scene in the other rotation charts.
macro_rules! other_charts {
    ($scene:ident, $motion:ident) => {
        $scene!(Xyz XyzKernel, $motion, [jet(euler_xyz)]);
        $scene!(Xzy XzyKernel, $motion, [jet(euler_xzy)]);
        $scene!(Yxz YxzKernel, $motion, [jet(euler_yxz)]);
        $scene!(Yzx YzxKernel, $motion, [jet(euler_yzx)]);
        $scene!(Zxy ZxyKernel, $motion, [jet(euler_zxy)]);
        $scene!(Zyz ZyzKernel, $motion, [jet(euler_zyz)]);
        $scene!(Xyx XyxKernel, $motion, [jet(euler_xyx)]);
        $scene!(Xzx XzxKernel, $motion, [jet(euler_xzx)]);
        $scene!(Yxy YxyKernel, $motion, [jet(euler_yxy)]);
        $scene!(Yzy YzyKernel, $motion, [jet(euler_yzy)]);
        $scene!(Rodrigues RodriguesKernel, $motion, [jet(rodrigues)]);
    };
}

/// The scene in every chart of planar motion.
macro_rules! planar_charts {
    ($scene:ident) => {
        $scene!(Left LeftKernel, planar, [left_invariant]);
        $scene!(Right RightKernel, planar, [right_invariant]);
        $scene!(Hybrid HybridKernel, planar, [hybrid]);
        $scene!(Jet JetKernel, planar, [jet]);
    };
}
