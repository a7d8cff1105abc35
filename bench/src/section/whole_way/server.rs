//! A server with the app on a port of its own.

use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail};

/// How long a server may take until it listens.
const PATIENCE: Duration = Duration::from_secs(30);

/// A running server; it ends with this value.
pub(super) struct Server {
    child: Child,
    port: u16,
}

impl Server {
    /// Starts `goalgraph serve`, which keeps its data in `folder`, and waits until it listens.
    ///
    /// # Errors
    ///
    /// When it cannot be started or does not listen.
    pub(super) fn start(goalgraph: &Path, folder: &Path) -> Result<Self> {
        let port = free_port()?;
        let mut command = Command::new(goalgraph);
        command.args(["serve", "--listen", &format!("127.0.0.1:{port}"), "--data"]).arg(folder.join("data"));
        command.env("GOALGRAPH_LOG", "warn").stdout(Stdio::null()).stderr(Stdio::null());
        let mut server = Self { child: command.spawn().context("cannot start the server")?, port };
        let started = Instant::now();
        while TcpStream::connect((Ipv4Addr::LOCALHOST, port)).is_err() {
            if started.elapsed() > PATIENCE || server.child.try_wait()?.is_some() {
                bail!("the server does not listen on port {port}");
            }
            thread::sleep(Duration::from_millis(50));
        }
        Ok(server)
    }

    /// Where a browser finds it.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/", self.port)
    }
}

impl Drop for Server {
    /// Nothing that it keeps is wanted any longer.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn free_port() -> Result<u16> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).context("no loopback port is free")?;
    Ok(listener.local_addr()?.port())
}
