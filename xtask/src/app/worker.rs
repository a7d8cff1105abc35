//! The worker in two builds, with SIMD and without: the page starts the one that the browser can run.
//!
//! Trunk gives all programs of a page the same profile and the same flags, so the worker is built beside it.

use std::process::Command;

use anyhow::Result;

use crate::process::{run, run_quietly};
use crate::progress::say;
use crate::project::Project;
use crate::setup::{TARGET, Tools};

const PROFILE: &str = "wasm-worker";

/// A build of the worker.
struct Build {
    /// What its files in `dist/` are called.
    name: &'static str,
    /// What the compiler may use beyond what every browser has.
    target_feature: Option<&'static str>,
}

const BUILDS: [Build; 2] = [
    Build { name: "worker_plain", target_feature: None },
    Build { name: "worker_simd", target_feature: Some("+simd128") },
];

/// Builds the worker into `dist/`.
///
/// # Errors
///
/// When it does not compile or `dist/` cannot be written.
pub(super) fn build(project: &Project, tools: &Tools) -> Result<()> {
    BUILDS.iter().try_for_each(|build| build.run(project, tools))
}

impl Build {
    fn run(&self, project: &Project, tools: &Tools) -> Result<()> {
        say(&format!("app: {}", self.name));
        let (mut cargo, results) = tools.build_for_the_browser();
        run(self.compile(&mut cargo))?;
        // The next build takes the place of this one.
        let compiled = results.join(PROFILE).join("worker.wasm");
        let mut bind = tools.program("wasm-bindgen");
        bind.args(["--target", "web", "--no-typescript", "--out-name", self.name, "--out-dir"]);
        run_quietly(bind.arg(project.dist()).arg(compiled))?;
        let module = project.dist().join(format!("{}_bg.wasm", self.name));
        run_quietly(tools.program("wasm-opt").arg("-O3").arg(&module).arg("-o").arg(&module))
    }

    fn compile<'a>(&self, cargo: &'a mut Command) -> &'a mut Command {
        cargo.args(["--locked", "--offline", "--profile", PROFILE]);
        cargo.args(["--package", "goalgraph-web", "--no-default-features", "--bin", "worker"]);
        if let Some(feature) = self.target_feature {
            let flags = format!("target.{TARGET}.rustflags=[\"-Ctarget-feature={feature}\"]");
            cargo.args(["--config", &flags]);
        }
        cargo
    }
}
