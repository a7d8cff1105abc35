//! `goalgraph serve`: the app, the API and the relay.

use std::future::Future;
use std::io::{self, IsTerminal};
use std::net::{SocketAddr, ToSocketAddrs};
use std::path::PathBuf;
use std::sync::Arc;

use axum_server::Handle;
use clap::{Args, ValueEnum};
use goalgraph_server::access::{Access, AccessSettings, end_revoked};
use goalgraph_server::api::Api;
use goalgraph_server::relay::{Relay, RelayLimits};
use goalgraph_server::server::{BindError, Listening, PATIENCE, Tls, app, embedded};
use goalgraph_server::store::{Store, StoreOptions};
use tokio::runtime::Runtime;
use tracing_subscriber::EnvFilter;

use super::store_arguments::StoreArguments;
use crate::failure::Failure;
use crate::output;
use crate::stop::stop_signal;

/// Arguments of `goalgraph serve`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// Address and port; port 0 takes any that is free. Beyond this computer tokens are needed
    #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:7700")]
    listen: String,
    #[command(flatten)]
    store: StoreArguments,
    /// Ask for tokens on this computer as well, as behind a proxy
    #[arg(long)]
    require_token: bool,
    /// Certificate for https, a PEM file
    #[arg(long, value_name = "FILE", requires = "tls_key")]
    tls_certificate: Option<PathBuf>,
    /// Private key of the certificate, a PEM file
    #[arg(long, value_name = "FILE", requires = "tls_certificate")]
    tls_key: Option<PathBuf>,
    /// A page of another server that may ask, such as the address of a proxy; repeatable
    #[arg(long, value_name = "https://HOST")]
    origin: Vec<String>,
    /// How the log on standard error is written; the variable `GOALGRAPH_LOG` says how much (error, warn, info, debug)
    #[arg(long, value_enum, default_value_t)]
    log: LogFormat,
}

/// Value of `--log`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum LogFormat {
    /// Lines to read
    #[default]
    Text,
    /// One JSON object a line
    Json,
}

/// Serves until the program is told to stop (Ctrl+C or SIGTERM).
///
/// # Errors
///
/// When the address is taken, the store cannot be opened, or others could connect and no token was made.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let addresses = addresses(&arguments.listen)?;
    start_log(arguments.log);
    let runtime = Runtime::new().map_err(|error| Failure::input(error.to_string()))?;
    runtime.block_on(serve(arguments, &addresses))
}

/// The addresses that `listen` stands for.
fn addresses(listen: &str) -> Result<Vec<SocketAddr>, Failure> {
    let unknown = |_| {
        Failure::Usage(format!(
            "error: --listen {listen}: expected an address and a port, such as 127.0.0.1:7700"
        ))
    };
    Ok(listen.to_socket_addrs().map_err(unknown)?.collect())
}

fn start_log(format: LogFormat) {
    let filter = EnvFilter::try_from_env("GOALGRAPH_LOG").unwrap_or_else(|_| EnvFilter::new("info"));
    let log = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(io::stderr)
        .with_ansi(io::stderr().is_terminal());
    // There is one already when tests run several servers in one program.
    let _ = match format {
        LogFormat::Text => log.with_target(false).try_init(),
        LogFormat::Json => log.json().try_init(),
    };
}

async fn serve(arguments: &Arguments, addresses: &[SocketAddr]) -> Result<(), Failure> {
    let location = arguments.store.location()?;
    let store = Store::open(&location, StoreOptions::default())
        .await
        .map_err(|error| Failure::input(format!("{location}: {error}")))?;
    let settings = access(arguments, addresses, &store).await?;
    let relay = Relay::open(store.clone(), RelayLimits::default())
        .await
        .map_err(|error| Failure::input(format!("{location}: {error}")))?;
    let failure = |error: io::Error| Failure::input(listen_error(&arguments.listen, &error));
    let stop = stop_signal().map_err(failure)?;
    let tls = tls(arguments);
    let listening = Listening::bind(addresses, tls.as_ref()).await.map_err(|error| match error {
        BindError::Address(error) => failure(error),
        BindError::Certificate(_) => Failure::input(error.to_string()),
    })?;
    // Not before it is known that no other server is at work here.
    store.remove_abandoned_uploads().await.map_err(|error| Failure::input(error.to_string()))?;
    announce(listening.address().map_err(failure)?, tls.is_some());
    let access = Arc::new(Access::new(settings, store.clone()));
    tokio::spawn(end_revoked(store.clone(), relay.clone()));
    let api = Api { store: store.clone(), relay: relay.clone(), access };
    let handle = Handle::new();
    let stopping = tokio::spawn(stop_gracefully(stop, relay, handle.clone()));
    let served = listening.serve(app(embedded, api), handle).await.map_err(failure);
    if served.is_ok() {
        // Sockets outlive the connections that they came by; what they sent is stored first. It cannot fail.
        let _ = stopping.await;
    }
    store.close().await;
    served
}

/// Ends sockets with a word, lets answers under way be finished, then ends the server.
async fn stop_gracefully(stop: impl Future<Output = ()>, relay: Relay, handle: Handle<SocketAddr>) {
    stop.await;
    tracing::info!("stopping");
    handle.graceful_shutdown(Some(PATIENCE));
    relay.shutdown().await;
}

/// Who is let in: everybody on this computer, or whoever has a token.
async fn access(
    arguments: &Arguments,
    addresses: &[SocketAddr],
    store: &Store,
) -> Result<AccessSettings, Failure> {
    let is_local = addresses.iter().all(|address| address.ip().is_loopback());
    let tokens_needed = arguments.require_token || !is_local;
    if tokens_needed {
        let tokens = store.tokens().await.map_err(|error| Failure::input(error.to_string()))?;
        if !tokens.iter().any(|token| token.revoked_at_ms.is_none()) {
            return Err(Failure::Usage(format!(
                "error: --listen {}: tokens tell who may connect, and there is none yet; make one with\n  \
                 goalgraph token create \"YOUR NAME\" --role approver{}",
                arguments.listen,
                arguments.store.again()
            )));
        }
    }
    let https = arguments.tls_certificate.is_some()
        || (!arguments.origin.is_empty() && arguments.origin.iter().all(|it| it.starts_with("https://")));
    Ok(AccessSettings { tokens_needed, origins: arguments.origin.clone(), https })
}

fn tls(arguments: &Arguments) -> Option<Tls> {
    let (certificate, key) = (arguments.tls_certificate.clone()?, arguments.tls_key.clone()?);
    Some(Tls { certificate, key })
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

fn announce(address: SocketAddr, encrypted: bool) {
    let scheme = if encrypted { "https" } else { "http" };
    // Without a standard output there is nobody to read it.
    let _ = output::print(&format!("Goalgraph is at {scheme}://{address}/ (Ctrl+C ends it)\n"));
}
