//! Packs the library that draws the charts of reports: once, when the program is built, not in each run.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "report")]
    charts::pack();
}

#[cfg(feature = "report")]
mod charts {
    use std::io::Write as _;
    use std::path::Path;

    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use flate2::Compression;
    use flate2::write::DeflateEncoder;

    /// Writes the script into the folder of what is built, as base64 of deflated bytes.
    pub fn pack() {
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(script().as_bytes()).expect("writing to memory cannot fail");
        let packed = encoder.finish().expect("writing to memory cannot fail");
        let folder = std::env::var("OUT_DIR").expect("cargo names the folder of what is built");
        let place = Path::new(&folder).join("plotly.min.js.deflate.base64");
        std::fs::write(place, STANDARD.encode(packed)).expect("the folder of what is built can be written");
    }

    /// Plotly.js as its crate carries it.
    fn script() -> String {
        // The crate hands it out as script tags of a page: first the library, then a typesetter of formulas.
        let tags = plotly::Plot::offline_js_sources();
        let library = tags.split("</script>").next().and_then(|tag| tag.split_once('>'));
        let (_, script) = library.expect("the crate's first tag is the library");
        assert!(script.contains("* plotly.js v"), "the crate's first script is not plotly.js");
        script.to_owned()
    }
}
