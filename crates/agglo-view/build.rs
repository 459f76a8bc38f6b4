//! Packs what runs in the pages of reports, with its digests: once, when the program is built, not in each run.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "report")]
    pages::pack();
}

#[cfg(feature = "report")]
mod pages {
    use std::io::Write as _;
    use std::path::Path;

    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use flate2::Compression;
    use flate2::write::DeflateEncoder;
    use sha2::{Digest, Sha256};

    /// The scripts of a page, in the order in which they need each other.
    const OWN: [&str; 9] =
        ["colors", "replay_data", "walls", "scene", "camera", "pointers", "replay", "charts", "page"];

    /// Writes the page's script as it stands between its tags, and the library that draws its charts as base64 of
    /// deflated bytes; and the digest of each, by which a page knows its own scripts.
    pub fn pack() {
        let own = format!("\n{}", OWN.map(own).join("\n"));
        put("page.js", &own);
        put("page.sha256", &digest(&own));
        let library = library();
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(library.as_bytes()).expect("writing to memory cannot fail");
        let packed = encoder.finish().expect("writing to memory cannot fail");
        put("plotly.min.js.deflate.base64", &STANDARD.encode(packed));
        put("plotly.sha256", &digest(&library));
    }

    /// As content policies have it.
    fn digest(script: &str) -> String {
        format!("'sha256-{}'", STANDARD.encode(Sha256::digest(script.as_bytes())))
    }

    fn put(name: &str, text: &str) {
        let folder = std::env::var("OUT_DIR").expect("cargo names the folder of what is built");
        std::fs::write(Path::new(&folder).join(name), text)
            .expect("the folder of what is built can be written");
    }

    fn own(name: &str) -> String {
        let place = format!("src/report/page/{name}.js");
        println!("cargo::rerun-if-changed={place}");
        std::fs::read_to_string(&place).expect("the page's scripts are there")
    }

    /// Plotly.js as its crate carries it.
    fn library() -> String {
        // The crate hands it out as script tags of a page: first the library, then a typesetter of formulas.
        let tags = plotly::Plot::offline_js_sources();
        let library = tags.split("</script>").next().and_then(|tag| tag.split_once('>'));
        let (_, script) = library.expect("the crate's first tag is the library");
        assert!(script.contains("* plotly.js v"), "the crate's first script is not plotly.js");
        script.to_owned()
    }
}
