//! Generates Rust from the contract. Needs cargo only: protox reads the proto files, no protoc.

use prost::Message;
use std::path::Path;

const ROOT: &str = "../../proto";
const FILES: &[&str] = &["traverse/v1/service.proto"];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo:rerun-if-changed={ROOT}");
    let descriptors = protox::Compiler::new([ROOT])?
        .include_imports(true)
        .include_source_info(true)
        .open_files(FILES)?
        .file_descriptor_set();
    let out = std::env::var("OUT_DIR")?;
    std::fs::write(Path::new(&out).join("traverse.bin"), descriptors.encode_to_vec())?;
    tonic_prost_build::configure().codec_path("crate::codec::WireCodec").compile_fds(descriptors)?;
    Ok(())
}
