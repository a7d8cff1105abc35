//! Compressed copies of the app's files, made once at build time: better and cheaper than at every request.

use std::ffi::OsStr;
use std::fmt;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// What gains from compression.
const EXTENSIONS: [&str; 3] = ["wasm", "js", "css"];
const QUALITY: u32 = 11;
const WINDOW_BITS: u32 = 22;
const BUFFER_BYTES: usize = 4096;

/// A file with a compressed copy beside it.
pub(super) struct CompressedFile {
    /// The file itself; its copy has `.br` after the name.
    pub(super) path: PathBuf,
    raw_bytes: usize,
    compressed_bytes: usize,
}

/// Compresses every file in a folder and below that gains from it; gives them in the order of their paths.
///
/// # Errors
///
/// When the folder cannot be read or written.
pub(super) fn compress_folder(folder: &Path) -> Result<Vec<CompressedFile>> {
    let mut paths = Vec::new();
    collect(folder, &mut paths).with_context(|| format!("cannot read {}", folder.display()))?;
    paths.sort();
    paths.into_iter().map(compress).collect()
}

fn collect(folder: &Path, paths: &mut Vec<PathBuf>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, paths)?;
        } else if EXTENSIONS.iter().any(|it| path.extension() == Some(OsStr::new(it))) {
            paths.push(path);
        }
    }
    Ok(())
}

fn compress(path: PathBuf) -> Result<CompressedFile> {
    let raw = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let mut writer = brotli::CompressorWriter::new(Vec::new(), BUFFER_BYTES, QUALITY, WINDOW_BITS);
    writer.write_all(&raw)?;
    let compressed = writer.into_inner();
    let mut name = path.clone().into_os_string();
    name.push(".br");
    fs::write(&name, &compressed).with_context(|| format!("cannot write {}", name.display()))?;
    Ok(CompressedFile { path, raw_bytes: raw.len(), compressed_bytes: compressed.len() })
}

impl fmt::Display for CompressedFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.path.file_name().unwrap_or_default().display();
        let [raw, compressed] = [self.raw_bytes, self.compressed_bytes].map(|it| it.div_ceil(1000));
        write!(f, "{name} has {raw} kB, compressed {compressed} kB")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_decompresses_to_the_file_and_other_files_have_none() {
        let folder = std::env::temp_dir().join(format!("goalgraph-compress-{}", std::process::id()));
        fs::create_dir_all(folder.join("deeper")).expect("a folder");
        let script = "let a = 1;".repeat(500);
        fs::write(folder.join("deeper/app.js"), &script).expect("a file");
        fs::write(folder.join("index.html"), "<p>").expect("a file");

        let files = compress_folder(&folder).expect("compresses");

        let lines: Vec<String> = files.iter().map(ToString::to_string).collect();
        assert_eq!(lines, ["app.js has 5 kB, compressed 1 kB"]);
        let copy = fs::read(folder.join("deeper/app.js.br")).expect("the copy");
        let mut decompressed = Vec::new();
        brotli::BrotliDecompress(&mut copy.as_slice(), &mut decompressed).expect("brotli");
        assert_eq!(decompressed, script.as_bytes());
        assert!(!folder.join("index.html.br").exists());
        fs::remove_dir_all(folder).expect("cleaned up");
    }
}
