//! Connections: taken up to a limit, served over HTTP/1.1 or HTTP/2, drained in the end.

use crate::http_service::HttpService;
use hyper_util::rt::{TokioExecutor, TokioIo, TokioTimer};
use hyper_util::server::conn::auto;
use hyper_util::service::TowerToHyperService;
use std::pin::pin;
use std::sync::Arc;
use std::time::Duration;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

/// A connection has to say something within this time; so has every HTTP/1.1 request with its head.
const FIRST_WORD: Duration = Duration::from_secs(10);

/// HTTP/2: an idle peer is asked this often whether it is there, and has this long to say so.
const KEEP_ALIVE: (Duration, Duration) = (Duration::from_secs(30), Duration::from_secs(20));

/// HTTP/2: calls at once on one connection. The queue bounds them all.
const STREAMS: u32 = 256;

/// What a call may send ahead of what is read of it, bytes.
const STREAM_WINDOW: u32 = 256 * 1024;

/// The same for all calls of a connection, bytes. A connection on which small frames pile up is closed by the HTTP/2 library
/// (256 bytes less each one's own, summed over what is not read yet, beyond half of this window): a session's steps, some
/// 50 bytes each, must fit many times.
const CONNECTION_WINDOW: u32 = 8 * 1024 * 1024;

/// Largest head of a request, bytes: over HTTP/1.1 all of it, over HTTP/2 its header list. Bodies are bounded elsewhere:
/// over HTTP/1.1 this is also how much of one is read at once.
const HEADER_BYTES: u32 = 16 << 10;

/// After a failed accept (out of file descriptors, mostly) others may end in the meantime.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// What is left of connections after the hard stop may send its last words for so long.
const LAST_WORDS: Duration = Duration::from_millis(500);

/// How to stop.
pub(crate) struct Drain {
    /// Raised when it begins.
    pub(crate) begun: CancellationToken,
    /// How long calls may go on.
    pub(crate) grace: Duration,
    /// Raised after it.
    pub(crate) hard_stop: CancellationToken,
}

/// Serves connections until `shutdown` ends, then drains.
pub(crate) async fn accept(
    listener: TcpListener,
    service: HttpService,
    limit: usize,
    shutdown: impl Future<Output = ()>,
    drain: Drain,
) {
    let places = Arc::new(Semaphore::new(limit.min(Semaphore::MAX_PERMITS)));
    let leave = drain.begun;
    let mut connections = JoinSet::new();
    let mut shutdown = pin!(shutdown);
    loop {
        let next = async {
            let place = Arc::clone(&places).acquire_owned().await;
            (listener.accept().await, place)
        };
        tokio::select! {
            () = &mut shutdown => break,
            Some(_) = connections.join_next(), if !connections.is_empty() => {}
            (accepted, place) = next => match accepted {
                Ok((stream, _)) => {
                    let (service, leave) = (service.clone(), leave.clone());
                    connections.spawn(async move {
                        serve_connection(stream, service, leave).await;
                        drop(place);
                    });
                }
                Err(error) => {
                    tracing::warn!(%error, "a connection could not be accepted");
                    tokio::time::sleep(ACCEPT_PAUSE).await;
                }
            },
        }
    }
    drop(listener);
    leave.cancel();
    if tokio::time::timeout(drain.grace, all(&mut connections)).await.is_err() {
        tracing::warn!(connections = connections.len(), "the grace is over: cancelling what still runs");
        drain.hard_stop.cancel();
        tokio::time::timeout(LAST_WORDS, all(&mut connections)).await.ok();
    }
    drain.hard_stop.cancel();
    connections.shutdown().await;
}

async fn all(connections: &mut JoinSet<()>) {
    while connections.join_next().await.is_some() {}
}

async fn serve_connection(stream: TcpStream, service: HttpService, leave: CancellationToken) {
    stream.set_nodelay(true).ok();
    tokio::select! {
        () = leave.cancelled() => return,
        spoken = tokio::time::timeout(FIRST_WORD, stream.readable()) => if !matches!(spoken, Ok(Ok(()))) {
            return;
        },
    }
    let mut builder = auto::Builder::new(TokioExecutor::new());
    builder
        .http1()
        .timer(TokioTimer::new())
        .header_read_timeout(FIRST_WORD)
        .max_buf_size(HEADER_BYTES as usize);
    builder
        .http2()
        .timer(TokioTimer::new())
        .keep_alive_interval(KEEP_ALIVE.0)
        .keep_alive_timeout(KEEP_ALIVE.1)
        .max_concurrent_streams(STREAMS)
        .initial_stream_window_size(STREAM_WINDOW)
        .initial_connection_window_size(CONNECTION_WINDOW)
        .max_header_list_size(HEADER_BYTES);
    let mut connection =
        pin!(builder.serve_connection(TokioIo::new(stream), TowerToHyperService::new(service)));
    let ended = tokio::select! {
        ended = connection.as_mut() => ended,
        () = leave.cancelled() => {
            connection.as_mut().graceful_shutdown();
            connection.await
        }
    };
    if let Err(error) = ended {
        tracing::debug!(%error, "a connection ended");
    }
}
