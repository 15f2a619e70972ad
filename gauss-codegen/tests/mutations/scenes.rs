//! What is gathered from the sources.

pub struct Scene {
    #[allow(dead_code)]
    pub name: String,
    pub source: String,
}
