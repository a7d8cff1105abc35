//! Debian's Rust compiler, with a standard library for the browser that is built here from Debian's source of it.
//!
//! For machines whose rustup cannot reach its server. Debian packages the compiler that its browsers are built with
//! (`rustc-web`) together with the library's source, but no compiled library for this target.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use super::apt;
use super::wasm_target::TARGET;
use crate::process::{first_line, forget_own_package, run_quietly};
use crate::progress::say;

const PACKAGES: [&str; 6] =
    ["rustc-web", "cargo-web", "rust-web-src", "rust-web-llvm", "rust-web-clippy", "lld-22"];
const RUSTC: &str = "/usr/bin/rustc";
const CARGO: &str = "/usr/bin/cargo";
/// Says which compiler built the library; written last.
const STAMP: &str = "built-with";

/// Debian's compiler and a sysroot with the library for [`TARGET`].
pub(super) struct DebianToolchain {
    sysroot: PathBuf,
    version: String,
}

impl DebianToolchain {
    /// The toolchain, when an earlier run has made it and the compiler has not changed since.
    pub(super) fn present(cache: &Path) -> Option<Self> {
        let sysroot = cache.join("sysroot");
        let version = first_line(Command::new(RUSTC).arg("--version"))?;
        let built_with = fs::read_to_string(sysroot.join(STAMP)).ok()?;
        (built_with == version).then_some(Self { sysroot, version })
    }

    /// The toolchain, installed and built where it is missing.
    ///
    /// # Errors
    ///
    /// When Debian's packages cannot be installed or the library does not build.
    pub(super) fn ensure(cache: &Path) -> Result<Self> {
        apt::ensure(&PACKAGES)?;
        if let Some(toolchain) = Self::present(cache) {
            return Ok(toolchain);
        }
        let version =
            first_line(Command::new(RUSTC).arg("--version")).context("Debian's rustc does not run")?;
        let toolchain = Self { sysroot: cache.join("sysroot"), version };
        say(&format!("set-up: the standard library for {TARGET}, with Debian's {}", toolchain.version));
        toolchain.build_library(&cache.join("sysroot-build")).context("cannot build the standard library")?;
        Ok(toolchain)
    }

    /// `rustc 1.96.0 ..`
    pub(super) fn version(&self) -> &str {
        &self.version
    }

    /// The compiler with the sysroot, for a single file.
    pub(super) fn rustc(&self) -> Command {
        let mut command = Command::new(RUSTC);
        command.arg("--sysroot").arg(&self.sysroot);
        command
    }

    /// Makes a program that calls cargo use this compiler, in the target folder `target`.
    ///
    /// Only what is compiled for [`TARGET`] sees the sysroot: macros and build scripts use the compiler's own library.
    pub(super) fn prepare(&self, command: &mut Command, target: &Path) {
        command
            .env("CARGO", CARGO)
            .env("RUSTC", RUSTC)
            .env("RUSTDOC", "/usr/bin/rustdoc")
            .env("CARGO_TARGET_DIR", target)
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", self.flags());
    }

    fn flags(&self) -> String {
        format!("--sysroot={}", self.sysroot.display())
    }

    fn build_library(&self, scratch: &Path) -> Result<()> {
        remove_folder(&self.sysroot)?;
        remove_folder(scratch)?;
        fs::create_dir_all(scratch.join("src"))?;
        fs::write(scratch.join("Cargo.toml"), MANIFEST)?;
        fs::write(scratch.join("src/lib.rs"), "")?;
        let target = scratch.join("target");
        let mut cargo = Command::new(CARGO);
        forget_own_package(&mut cargo);
        cargo
            .current_dir(scratch)
            .args(["build", "--release", "--target", TARGET, "-Zbuild-std=std,panic_abort,test"])
            .env("RUSTC", RUSTC)
            // A stable compiler refuses -Z without this.
            .env("RUSTC_BOOTSTRAP", "1")
            // Fat link-time optimization of the app reads the library's bitcode.
            .env("RUSTFLAGS", "-Cembed-bitcode=yes")
            .env("CARGO_TARGET_DIR", &target);
        run_quietly(&mut cargo)?;
        self.take_library(&target.join(TARGET).join("release/deps"))?;
        fs::write(self.sysroot.join(STAMP), &self.version)?;
        remove_folder(scratch)
    }

    /// Fills the sysroot with the library just built; linkers are found in the compiler's own.
    fn take_library(&self, built: &Path) -> Result<()> {
        let library = self.sysroot.join("lib/rustlib").join(TARGET).join("lib");
        fs::create_dir_all(&library)?;
        for file in fs::read_dir(built)? {
            let file = file?.path();
            if let (Some(name), true) = (file.file_name(), file.extension().is_some_and(|it| it == "rlib")) {
                fs::copy(&file, library.join(name))?;
            }
        }
        Ok(())
    }
}

const MANIFEST: &str = "[package]\nname = \"library\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\
    [lib]\ncrate-type = [\"cdylib\"]\n";

fn remove_folder(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot remove {}", folder.display()))?;
    }
    Ok(())
}
