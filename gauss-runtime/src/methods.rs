//! Tables with a value for each method of a kernel: its cost, its loss.

/// A struct with a value for each method, nothing as a constant, and its rows: one list of methods serves all three.
macro_rules! by_method {
    (
        $(#[$about:meta])*
        $table:ident of $value:ident = $none:expr;
        $($(#[$doc:meta])* $method:ident,)*
        $(; $(#[$besides_doc:meta])* $besides:ident: $kind:ty = $nothing:expr)?
    ) => {
        $(#[$about])*
        pub struct $table {
            $($(#[$doc])* pub $method: $value,)*
            $($(#[$besides_doc])* pub $besides: $kind,)?
        }

        impl $table {
            /// Nothing is known: to begin with, where methods are named one by one.
            pub const NONE: Self = Self { $($method: $none,)* $($besides: $nothing,)? };

            /// Names and values, in the order of the fields.
            fn rows(&self) -> impl Iterator<Item = (&'static str, $value)> {
                [$((stringify!($method), self.$method)),*].into_iter()
            }
        }
    };
}

pub(crate) use by_method;
