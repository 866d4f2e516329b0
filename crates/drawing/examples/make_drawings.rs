//! Writes the bundled drawings into `drawings/`: `cargo run -p traverse-drawing --example make_drawings`.
//!
//! Every coordinate is our own. The files are committed; a test checks that they are what this program writes.

#[path = "make_drawings/dxf_text.rs"]
mod dxf_text;
#[path = "make_drawings/leather_hide.rs"]
mod leather_hide;
#[path = "make_drawings/shoe_sections.rs"]
mod shoe_sections;
#[path = "make_drawings/turned_shaft.rs"]
mod turned_shaft;
#[path = "make_drawings/vise_and_clamps.rs"]
mod vise_and_clamps;

fn main() -> std::io::Result<()> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../drawings");
    std::fs::create_dir_all(&folder)?;
    for (name, text) in [
        ("vise-and-clamps.dxf", vise_and_clamps::text()),
        ("turned-shaft.dxf", turned_shaft::text()),
        ("leather-hide.dxf", leather_hide::text()),
        ("shoe-sections.svg", shoe_sections::text()),
    ] {
        std::fs::write(folder.join(name), text)?;
        println!("drawings/{name}");
    }
    Ok(())
}
