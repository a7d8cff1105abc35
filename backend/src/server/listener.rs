//! How connections are taken: plain or encrypted, and not more than can be served.

use std::future::Future;
use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;

use axum::Router;
use axum_server::Handle;
use axum_server::accept::{Accept, NoDelayAcceptor};
use axum_server::tls_rustls::{RustlsAcceptor, RustlsConfig};
use hyper_util::rt::TokioTimer;
use tokio::net::TcpStream;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tower::Service;

/// The most connections at a time; sockets of executors and pages are bounded by the relay on top.
const CONNECTIONS: usize = 10_000;
/// How long a client may take to send the head of a request.
const HEAD_TIMEOUT: Duration = Duration::from_secs(15);

/// Certificate and key for encrypted connections, as PEM files.
#[derive(Clone, Debug)]
pub struct Tls {
    /// The certificate, with those between it and its root.
    pub certificate: PathBuf,
    /// Its private key.
    pub key: PathBuf,
}

/// Why nothing can be listened to.
#[derive(Debug, thiserror::Error)]
pub enum BindError {
    /// The address is taken, or not one of this computer.
    #[error(transparent)]
    Address(#[from] io::Error),
    /// Certificate and key cannot be used: which, and why.
    #[error("{0}; expected a certificate and its private key, both as PEM")]
    Certificate(String),
}

/// A bound address whose connections are not taken yet.
pub struct Listening {
    listener: std::net::TcpListener,
    tls: Option<RustlsConfig>,
}

impl Listening {
    /// Binds one of `addresses`, the first that is free.
    ///
    /// # Errors
    ///
    /// When none is free, or certificate and key cannot be used.
    pub async fn bind(addresses: &[SocketAddr], tls: Option<&Tls>) -> Result<Self, BindError> {
        let tls = match tls {
            None => None,
            Some(Tls { certificate, key }) => {
                // An error says that it is installed already.
                let _ = rustls::crypto::ring::default_provider().install_default();
                let unusable = |error: io::Error| {
                    BindError::Certificate(format!(
                        "{} with {}: {error}",
                        certificate.display(),
                        key.display()
                    ))
                };
                Some(RustlsConfig::from_pem_file(certificate, key).await.map_err(unusable)?)
            }
        };
        let listener = std::net::TcpListener::bind(addresses)?;
        listener.set_nonblocking(true)?;
        Ok(Self { listener, tls })
    }

    /// Where it listens.
    ///
    /// # Errors
    ///
    /// When the system does not tell.
    pub fn address(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }

    /// Serves until `handle` is told to stop.
    ///
    /// # Errors
    ///
    /// When connections cannot be taken any more.
    pub async fn serve(self, app: Router, handle: Handle<SocketAddr>) -> io::Result<()> {
        let service = app.into_make_service_with_connect_info::<SocketAddr>();
        let plain = Bounded::new(NoDelayAcceptor::new());
        // Only of this version is the time bounded in which a client says what it wants.
        let mut server = axum_server::from_tcp(self.listener)?.handle(handle).http1_only();
        server.http_builder().http1().timer(TokioTimer::new()).header_read_timeout(HEAD_TIMEOUT);
        match self.tls {
            None => server.acceptor(plain).serve(service).await,
            Some(config) => {
                let encrypted = RustlsAcceptor::new(config).acceptor(plain);
                server.acceptor(encrypted).serve(service).await
            }
        }
    }
}

/// Takes a connection when there are not too many, and refuses it otherwise.
#[derive(Clone)]
struct Bounded {
    inner: NoDelayAcceptor,
    room: Arc<Semaphore>,
}

impl Bounded {
    fn new(inner: NoDelayAcceptor) -> Self {
        Self { inner, room: Arc::new(Semaphore::new(CONNECTIONS)) }
    }
}

impl<S: Send + 'static> Accept<TcpStream, S> for Bounded {
    type Stream = TcpStream;
    type Service = Admitted<S>;
    type Future = Pin<Box<dyn Future<Output = io::Result<(Self::Stream, Self::Service)>> + Send>>;

    fn accept(&self, stream: TcpStream, service: S) -> Self::Future {
        let (inner, room) = (self.inner, Arc::clone(&self.room));
        Box::pin(async move {
            let full = |_| io::Error::new(io::ErrorKind::ConnectionRefused, "too many connections");
            let permit = room.try_acquire_owned().map_err(full)?;
            let (stream, service) = inner.accept(stream, service).await?;
            Ok((stream, Admitted { service, _permit: Arc::new(permit) }))
        })
    }
}

/// A service that counts as a connection for as long as it is there.
#[derive(Clone)]
struct Admitted<S> {
    service: S,
    _permit: Arc<OwnedSemaphorePermit>,
}

impl<R, S: Service<R>> Service<R> for Admitted<S> {
    type Response = S::Response;
    type Error = S::Error;
    type Future = S::Future;

    fn poll_ready(&mut self, context: &mut Context<'_>) -> Poll<Result<(), S::Error>> {
        self.service.poll_ready(context)
    }

    fn call(&mut self, request: R) -> S::Future {
        self.service.call(request)
    }
}
