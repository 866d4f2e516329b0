//! The server: put together once, served until told to stop.

use crate::accept::{Drain, accept};
use crate::buffered::Buffered;
use crate::config::{Config, ConfigError};
use crate::connect::Connect;
use crate::dispatch::Dispatcher;
use crate::engines::{Engines, TraverseEngines};
use crate::front::Front;
use crate::guard::Guard;
use crate::http_service::HttpService;
use crate::planner_service::Planner;
use crate::pool::Pool;
use crate::session::Sessions;
use std::net::SocketAddr;
use std::sync::Arc;
use tokio::net::TcpListener;
use tokio_util::sync::CancellationToken;
use tonic::service::Routes;
use tonic_health::ServingStatus;
use tonic_health::server::{HealthReporter, health_reporter};
use traverse_proto::v1::planner_service_server::PlannerServiceServer;
use traverse_proto::{FILE_DESCRIPTOR_SET, PLANNER_SERVICE};

/// A server that is ready to serve: its configuration is sound, its workers run, no port is bound yet.
pub struct Server {
    config: Arc<Config>,
    service: HttpService,
    health: HealthReporter,
    drain: CancellationToken,
    hard_stop: CancellationToken,
}

/// Why a server can't start.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// A setting is wrong.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The system gives no more threads.
    #[error("can't start {workers} worker threads: {source}; set fewer workers")]
    Workers {
        /// How many were asked for.
        workers: usize,
        /// What the system says.
        source: std::io::Error,
    },
    /// The port can't be had.
    #[error("can't listen on {address}: {source}; stop what listens there or choose another address")]
    Listen {
        /// Which address.
        address: SocketAddr,
        /// What the system says.
        source: std::io::Error,
    },
    /// A built-in part is broken.
    #[error("the contract's description can't be served: {0}")]
    Reflection(#[from] tonic_reflection::server::Error),
}

impl Server {
    /// A server with the engines of this product.
    ///
    /// # Errors
    /// The configuration is wrong or the system gives no threads.
    pub fn new(config: Config) -> Result<Self, StartError> {
        Self::with_engines(config, TraverseEngines)
    }

    /// A server with engines of one's own.
    ///
    /// # Errors
    /// As [`Server::new`].
    pub fn with_engines(config: Config, engines: impl Engines) -> Result<Self, StartError> {
        config.check()?;
        let workers = config.workers;
        let pool = Pool::start(workers, config.queued_call_count)
            .map_err(|source| StartError::Workers { workers, source })?;
        let (drain, hard_stop) = (CancellationToken::new(), CancellationToken::new());
        let dispatcher = Arc::new(Dispatcher { pool, hard_stop: hard_stop.clone() });
        let config = Arc::new(config);
        let buffered = Buffered::new(config.buffered_bytes);
        let engines: Arc<dyn Engines> = Arc::new(engines);
        let planner = Planner {
            config: Arc::clone(&config),
            dispatcher: Arc::clone(&dispatcher),
            engines: Arc::clone(&engines),
        };
        let sessions = Sessions::new(&config, &dispatcher, &engines, &buffered, &drain);
        let sessions = Arc::new(sessions);
        let (health, routes) = routes(planner)?;
        let guard = Guard {
            routes,
            config: Arc::clone(&config),
            buffered: buffered.clone(),
            sessions: Arc::clone(&sessions),
            drain: drain.clone(),
        };
        let connect =
            Connect { grpc: guard.clone(), config: Arc::clone(&config), dispatcher, buffered, sessions };
        let service = HttpService::new(Front::new(guard, connect));
        Ok(Self { config, service, health, drain, hard_stop })
    }

    /// The whole service, to be called in process: no socket, but every check, limit and error of the server.
    #[must_use]
    pub fn http_service(&self) -> HttpService {
        self.service.clone()
    }

    /// Listens where the configuration says.
    ///
    /// # Errors
    /// The address can't be had.
    pub async fn bind(&self) -> Result<TcpListener, StartError> {
        let address = self.config.listen;
        TcpListener::bind(address).await.map_err(|source| StartError::Listen { address, source })
    }

    /// Serves until `shutdown` ends. Then: not serving for health checks, no new connections, calls may end within the
    /// grace, what is left is cancelled and answered UNAVAILABLE, connections are closed.
    ///
    /// # Errors
    /// The listener fails for good.
    pub async fn serve(
        self,
        listener: TcpListener,
        shutdown: impl Future<Output = ()>,
    ) -> std::io::Result<()> {
        let address = listener.local_addr()?;
        tracing::info!(%address, workers = self.config.workers, "listening");
        self.health.set_service_status(PLANNER_SERVICE, ServingStatus::Serving).await;
        let (health, grace) = (self.health.clone(), self.config.drain_grace);
        let begun = async move {
            shutdown.await;
            tracing::info!(?grace, "draining");
            for service in ["", PLANNER_SERVICE] {
                health.set_service_status(service, ServingStatus::NotServing).await;
            }
        };
        let drain = Drain { begun: self.drain, grace, hard_stop: self.hard_stop };
        accept(listener, self.service, self.config.connection_count, begun, drain).await;
        tracing::info!("stopped");
        Ok(())
    }
}

fn routes(planner: Planner) -> Result<(HealthReporter, Routes), StartError> {
    // The guard has checked sizes already, by a limit of its own and with an error that says more.
    let planner = PlannerServiceServer::new(planner).max_decoding_message_size(usize::MAX);
    let (health, health_service) = health_reporter();
    let reflection = || {
        tonic_reflection::server::Builder::configure()
            .register_encoded_file_descriptor_set(FILE_DESCRIPTOR_SET)
            .register_encoded_file_descriptor_set(tonic_health::pb::FILE_DESCRIPTOR_SET)
    };
    let routes = Routes::new(planner)
        .add_service(health_service)
        .add_service(reflection().build_v1()?)
        .add_service(reflection().build_v1alpha()?)
        .prepare();
    Ok((health, routes))
}
