//! What the compiler says about each kind of mistake, word for word and at the right token.
//!
//! A package of its own: each mistake is compiled in a project with the dependencies of this package, built once more for it.
//! After a deliberate change of a message: `TRYBUILD=overwrite cargo test -p gauss-compile-fail`, and read the difference
//! before keeping it.

#[cfg(test)]
#[test]
fn mistakes() {
    trybuild::TestCases::new().compile_fail("*.rs");
}
