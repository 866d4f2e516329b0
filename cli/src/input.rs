//! Files and standard input, with errors that say what to do.

use crate::failure::Failure;
use std::fs;
use std::io::Read;
use std::path::Path;

/// Longest file that is read, bytes.
const FILE_BYTES: u64 = 256 << 20;

/// The whole file; standard input for `-`.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let wrong = |error: std::io::Error| Failure::Input(format!("can't read {}: {error}", path.display()));
    let mut bytes = Vec::new();
    if path.as_os_str() == "-" {
        std::io::stdin().lock().take(FILE_BYTES + 1).read_to_end(&mut bytes).map_err(wrong)?;
    } else {
        fs::File::open(path).map_err(wrong)?.take(FILE_BYTES + 1).read_to_end(&mut bytes).map_err(wrong)?;
    }
    if bytes.len() as u64 > FILE_BYTES {
        return Err(Failure::Input(format!(
            "{} is longer than {FILE_BYTES} bytes; split it",
            path.display()
        )));
    }
    Ok(bytes)
}

/// Writes the file, making its folder where that is missing.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    let wrong = |error: std::io::Error| Failure::Input(format!("can't write {}: {error}", path.display()));
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(wrong)?;
    }
    fs::write(path, bytes).map_err(wrong)
}
