//! `goalgraph serve`: the app for browsers on this computer.

use std::future::Future;
use std::io;
use std::net::{SocketAddr, ToSocketAddrs};
use std::time::Duration;

use clap::Args;
use goalgraph_server::server::{app, embedded};
use tokio::net::TcpListener;
use tokio::runtime::Runtime;

use crate::failure::Failure;
use crate::output;

/// How long answers that are under way may take once the server is told to stop.
const PATIENCE: Duration = Duration::from_secs(3);

/// Arguments of `goalgraph serve`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Address and port of this computer; port 0 takes any that is free
    #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:7700")]
    listen: String,
}

/// Serves until the program is told to stop (Ctrl+C or SIGTERM).
///
/// # Errors
///
/// When the address is not one of this computer alone, or is taken.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let addresses = loopback_addresses(&arguments.listen)?;
    let failure = |error: io::Error| Failure::input(listen_error(&arguments.listen, &error));
    Runtime::new().and_then(|runtime| runtime.block_on(serve(&addresses))).map_err(failure)
}

/// The addresses that `listen` stands for, all of them of this computer alone.
fn loopback_addresses(listen: &str) -> Result<Vec<SocketAddr>, Failure> {
    let unknown = |_| {
        Failure::Usage(format!(
            "error: --listen {listen}: expected an address and a port, such as 127.0.0.1:7700"
        ))
    };
    let addresses: Vec<SocketAddr> = listen.to_socket_addrs().map_err(unknown)?.collect();
    if addresses.iter().all(|address| address.ip().is_loopback()) {
        return Ok(addresses);
    }
    Err(Failure::Usage(format!(
        "error: --listen {listen}: other computers could connect, and there is nothing yet to tell who may; use 127.0.0.1"
    )))
}

fn listen_error(listen: &str, error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::AddrInUse => {
            format!(
                "{listen}: another program listens there; choose another port with --listen, or end that program"
            )
        }
        io::ErrorKind::PermissionDenied => {
            format!("{listen}: not permitted; choose a port above 1023 with --listen")
        }
        _ => format!("{listen}: {error}"),
    }
}

async fn serve(addresses: &[SocketAddr]) -> io::Result<()> {
    let listener = TcpListener::bind(addresses).await?;
    let (told, stopping) = tokio::sync::oneshot::channel::<()>();
    let stop = stop_signal()?;
    announce(listener.local_addr()?);
    let graceful = axum::serve(listener, app(embedded)).with_graceful_shutdown(async move {
        stop.await;
        // Whether the server still listens to it or has ended makes no difference.
        let _ = told.send(());
    });
    let deadline = async move {
        if stopping.await.is_err() {
            std::future::pending::<()>().await;
        }
        tokio::time::sleep(PATIENCE).await;
    };
    tokio::select! {
        served = graceful => served,
        () = deadline => Ok(()),
    }
}

fn announce(address: SocketAddr) {
    // Without a standard output there is nobody to read it.
    let _ = output::print(&format!("Goalgraph is at http://{address}/ (Ctrl+C ends it)\n"));
}

/// Ends when the program is told to stop; it is listened for from the call on.
#[cfg(unix)]
fn stop_signal() -> io::Result<impl Future<Output = ()>> {
    use tokio::signal::unix::{SignalKind, signal};
    let mut interrupt = signal(SignalKind::interrupt())?;
    let mut terminate = signal(SignalKind::terminate())?;
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
    })
}

/// Ends when the program is told to stop.
#[cfg(not(unix))]
fn stop_signal() -> io::Result<impl Future<Output = ()>> {
    Ok(async {
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    })
}
