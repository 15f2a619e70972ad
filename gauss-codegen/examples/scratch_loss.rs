mod structures;
fn main() {
    for arg in std::env::args().skip(1) {
        let source = match arg.as_str() {
            "free" => structures::free_body(""),
            "torpedo" => structures::torpedo(""),
            "top" => structures::top(""),
            "arm" => structures::arm(""),
            "planar4" => structures::planar(4, true),
            "planar2" => structures::planar(2, true),
            "spatial18" => structures::spatial(18),
            _ => arg.clone(),
        };
        let input: syn::DeriveInput = syn::parse_str(&source).expect("struct");
        let t = std::time::Instant::now();
        gauss_codegen::expand(&input).expect("scene");
        eprintln!("{} in {:?}", &source[..60.min(source.len())], t.elapsed());
    }
}
