//! A server on a free port, stopped at the end.

use std::net::SocketAddr;
use tokio::sync::oneshot;
use tokio::task::JoinHandle;
use tonic::transport::Channel;
use traverse_proto::v1::planner_service_client::PlannerServiceClient;
use traverse_server::{Config, Engines, Server, TraverseEngines};

/// Nothing in these tests takes long; what takes this long hangs.
pub(crate) const HANG: std::time::Duration = std::time::Duration::from_secs(60);

pub(crate) struct Running {
    pub(crate) address: SocketAddr,
    stop: oneshot::Sender<()>,
    served: JoinHandle<std::io::Result<()>>,
}

impl Running {
    pub(crate) async fn start() -> Self {
        Self::with(Config::on_free_port(), TraverseEngines).await
    }

    pub(crate) async fn with(config: Config, engines: impl Engines) -> Self {
        let server = Server::with_engines(config, engines).expect("sound settings");
        let listener = server.bind().await.expect("a free port");
        let address = listener.local_addr().expect("bound");
        let (stop, stopped) = oneshot::channel::<()>();
        let served = tokio::spawn(server.serve(listener, async {
            stopped.await.ok();
        }));
        Self { address, stop, served }
    }

    pub(crate) async fn channel(&self) -> Channel {
        let uri = format!("http://{}", self.address);
        Channel::from_shared(uri).expect("an address").connect().await.expect("it listens")
    }

    pub(crate) async fn client(&self) -> PlannerServiceClient<Channel> {
        PlannerServiceClient::new(self.channel().await)
    }

    /// Tells it to stop; what it returns ends when it has.
    pub(crate) fn stop(self) -> JoinHandle<std::io::Result<()>> {
        self.stop.send(()).ok();
        self.served
    }
}
