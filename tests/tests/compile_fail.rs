//! What the compiler says about each kind of mistake, word for word and at the right token.
//!
//! After a deliberate change of a message: `TRYBUILD=overwrite cargo test -p gauss-tests --test compile_fail`, and read
//! the difference before keeping it.

#[test]
fn mistakes() {
    trybuild::TestCases::new().compile_fail("compile_fail/*.rs");
}
