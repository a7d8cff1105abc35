//! Requests of every kind that the OpenAPI document allows, and many that it does not, against the real server.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result};

use crate::process::run;
use crate::project::Project;

/// What every answer must be: no fault of the server, and what the document says.
const CHECKS: &str = "not_a_server_error,status_code_conformance,content_type_conformance,\
                      response_headers_conformance,response_schema_conformance,unsupported_method,\
                      allow_header_conformance,ignored_auth";

/// Below what the server takes from one address in a second.
const RATE: &str = "150/s";

/// Runs schemathesis, one of the programs in the folder `python`, against the server `program`.
///
/// # Errors
///
/// When the server does not start, or one of its answers is wrong.
pub(super) fn check(project: &Project, program: &Path, python: &Path) -> Result<()> {
    let server = Server::start(program, project.target.join("api-test"))?;
    let mut schemathesis = Command::new(python.join("schemathesis"));
    schemathesis.current_dir(&server.data).args(["run", &format!("{}api/openapi.json", server.url)]);
    schemathesis.args(["--checks", CHECKS, "--rate-limit", RATE, "--max-examples", "40", "--seed", "1"]);
    // The two sockets answer to a plain request with a problem, and there is nothing more to ask of them so.
    run(schemathesis.args(["--exclude-path-regex", "/(executor|monitor)$", "--no-color"]))
}

/// The server on a port of its own; killed when it is dropped, and its data removed.
struct Server {
    process: Child,
    url: String,
    data: PathBuf,
}

impl Server {
    fn start(program: &Path, data: PathBuf) -> Result<Self> {
        // It is not there unless an earlier run was killed.
        let _ = fs::remove_dir_all(&data);
        let mut command = Command::new(program);
        command.args(["serve", "--listen", "127.0.0.1:0", "--data"]).arg(&data);
        command.env("GOALGRAPH_LOG", "warn").stdout(Stdio::piped());
        let mut process = command.spawn().context("cannot start the server")?;
        let mut line = String::new();
        if let Some(output) = process.stdout.take() {
            BufReader::new(output).read_line(&mut line).context("cannot read what the server says")?;
        }
        let url = line.split(' ').find(|word| word.starts_with("http://")).map(ToOwned::to_owned);
        let mut server = Self { process, url: String::new(), data };
        server.url = url.context("the server does not tell its address")?;
        Ok(server)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // When it has ended already there is nothing to end.
        let _ = self.process.kill();
        let _ = self.process.wait();
        let _ = fs::remove_dir_all(&self.data);
    }
}
