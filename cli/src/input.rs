//! Files and standard input, with errors that say what to do.

use crate::failure::Failure;
use bytes::Bytes;
use futures_util::Stream;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// Longest file that is read, bytes.
const FILE_BYTES: u64 = 256 << 20;

/// Lines that are read ahead of what is sent.
const LINES_AHEAD: usize = 64;

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

/// The lines of the file, of standard input for `-`, as they come; empty ones are left out. Few are read ahead.
pub(crate) fn lines(path: &Path) -> Result<impl Stream<Item = Bytes> + Send + Unpin + 'static, Failure> {
    let name = path.display().to_string();
    let from: Box<dyn Read + Send> = if path.as_os_str() == "-" {
        Box::new(std::io::stdin())
    } else {
        let file = fs::File::open(path);
        Box::new(file.map_err(|error| Failure::Input(format!("can't read {name}: {error}")))?)
    };
    let (feed, mut lines) = tokio::sync::mpsc::channel::<Bytes>(LINES_AHEAD);
    // A thread of its own: reading standard input can't be broken off, and must not hold up the end of the process.
    std::thread::spawn(move || {
        let mut from = BufReader::new(from);
        loop {
            let mut line = Vec::new();
            match (&mut from).take(FILE_BYTES).read_until(b'\n', &mut line) {
                Ok(0) => return,
                Ok(_) => {}
                Err(error) => {
                    eprintln!("traverse: can't read on in {name}: {error}");
                    return;
                }
            }
            let line = line.trim_ascii();
            if !line.is_empty() && feed.blocking_send(Bytes::copy_from_slice(line)).is_err() {
                return;
            }
        }
    });
    Ok(futures_util::stream::poll_fn(move |context| lines.poll_recv(context)))
}

/// Writes the file, making its folder where that is missing.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    let wrong = |error: std::io::Error| Failure::Input(format!("can't write {}: {error}", path.display()));
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(wrong)?;
    }
    fs::write(path, bytes).map_err(wrong)
}
