//! PlannerService: each call is read, validated and answered on a worker.

use crate::call::{Call, Facts, Protocol};
use crate::config::Config;
use crate::deadline::{Asked, TimeLimits};
use crate::dispatch::Dispatcher;
use crate::engines::Engines;
use crate::limits_answer::limits_answer;
use crate::sections_service;
use crate::tool_change;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tonic::{Code, Request, Response, Status};
use traverse_geometry::Scene;
use traverse_planner::Answer;
use traverse_proto::v1::planner_service_server::PlannerService;
use traverse_proto::v1::{
    CheckRapidMoveRequest, CheckRapidMoveResponse, CheckSectionsRequest, CheckSectionsResponse,
    GetLimitsRequest, GetLimitsResponse, OrderSectionsRequest, OrderSectionsResponse, PlaceToolChangeRequest,
    PlaceToolChangeResponse, PlanRapidMoveRequest, PlanRapidMoveResponse,
};
use traverse_proto::{
    CheckQuestion, CountedLimit, PlanQuestion, Refused, check_answer, plan_answer,
    requested_order_time_limit, requested_time_limit, rules_time_limit, sound_answer,
};
use traverse_solve::{Budget, Interrupt};

/// How long the caller is ready to wait, as the transport says it, and since when the request is complete.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    pub(crate) timeout: Option<Duration>,
    pub(crate) read_at: Instant,
}

/// The service.
pub(crate) struct Planner {
    pub(crate) config: Arc<Config>,
    pub(crate) dispatcher: Arc<Dispatcher>,
    pub(crate) engines: Arc<dyn Engines>,
}

#[tonic::async_trait]
impl PlannerService for Planner {
    async fn plan_rapid_move(
        &self,
        request: Request<PlanRapidMoveRequest>,
    ) -> Result<Response<PlanRapidMoveResponse>, Status> {
        let call = call_of(&request);
        let deadline = self.deadline(&call, &request, requested_time_limit(request.get_ref()));
        let (config, engines) = (Arc::clone(&self.config), Arc::clone(&self.engines));
        let (facts, request) = (Arc::clone(&call), request.into_inner());
        let work = move |budget: &Budget| plan(&config, &*engines, &facts, request, budget);
        self.answer(&call, self.dispatcher.run(&call, deadline, work).await)
    }

    async fn place_tool_change(
        &self,
        request: Request<PlaceToolChangeRequest>,
    ) -> Result<Response<PlaceToolChangeResponse>, Status> {
        let call = call_of(&request);
        let deadline = self.deadline(&call, &request, rules_time_limit(request.get_ref().rules.as_ref()));
        let (config, engines) = (Arc::clone(&self.config), Arc::clone(&self.engines));
        let (facts, request) = (Arc::clone(&call), request.into_inner());
        let work = move |budget: &Budget| tool_change::place(&config, &*engines, &facts, request, budget);
        self.answer(&call, self.dispatcher.run(&call, deadline, work).await)
    }

    async fn check_rapid_move(
        &self,
        request: Request<CheckRapidMoveRequest>,
    ) -> Result<Response<CheckRapidMoveResponse>, Status> {
        let call = call_of(&request);
        let deadline = self.deadline(&call, &request, None);
        let (config, engines) = (Arc::clone(&self.config), Arc::clone(&self.engines));
        let (facts, request) = (Arc::clone(&call), request.into_inner());
        let work = move |budget: &Budget| check(&config, &*engines, &facts, request, budget);
        self.answer(&call, self.dispatcher.run(&call, deadline, work).await)
    }

    async fn order_sections(
        &self,
        request: Request<OrderSectionsRequest>,
    ) -> Result<Response<OrderSectionsResponse>, Status> {
        let call = call_of(&request);
        let asked = requested_order_time_limit(request.get_ref());
        let deadline = self.deadline(&call, &request, asked);
        let unasked = self.deadline(&call, &request, Some(self.config.longest_time_limit));
        let limit = match deadline.zip(unasked) {
            Some((deadline, unasked)) if asked.is_some() && deadline < unasked => CountedLimit::Requested,
            _ => CountedLimit::Deadline,
        };
        let (config, engines) = (Arc::clone(&self.config), Arc::clone(&self.engines));
        let (facts, request) = (Arc::clone(&call), request.into_inner());
        let work = move |budget: &Budget| {
            sections_service::order(&config, &*engines, &facts, limit, request, budget)
        };
        self.answer(&call, self.dispatcher.run(&call, deadline, work).await)
    }

    async fn check_sections(
        &self,
        request: Request<CheckSectionsRequest>,
    ) -> Result<Response<CheckSectionsResponse>, Status> {
        let call = call_of(&request);
        let deadline = self.deadline(&call, &request, None);
        let (config, engines) = (Arc::clone(&self.config), Arc::clone(&self.engines));
        let (facts, request) = (Arc::clone(&call), request.into_inner());
        let work =
            move |budget: &Budget| sections_service::check(&config, &*engines, &facts, request, budget);
        self.answer(&call, self.dispatcher.run(&call, deadline, work).await)
    }

    async fn get_limits(
        &self,
        request: Request<GetLimitsRequest>,
    ) -> Result<Response<GetLimitsResponse>, Status> {
        let call = call_of(&request);
        self.answer(&call, Ok((limits_answer(&self.config), "limits")))
    }
}

impl Planner {
    fn deadline<T>(&self, call: &Call, request: &Request<T>, body: Option<Duration>) -> Option<Instant> {
        let reading = request.extensions().get::<Reading>();
        let limits =
            TimeLimits { default: self.config.default_time_limit, longest: self.config.longest_time_limit };
        limits.deadline(&Asked {
            arrival: call.arrival,
            read_at: reading.map_or(call.arrival, |reading| reading.read_at),
            body,
            transport: reading.and_then(|reading| reading.timeout),
        })
    }

    fn answer<T: prost::Message>(
        &self,
        call: &Call,
        result: Result<(T, &'static str), Refused>,
    ) -> Result<Response<T>, Status> {
        let limit = self.config.limits.message_bytes;
        let bounded = result.and_then(|(message, outcome)| match message.encoded_len() {
            bytes if bytes > limit => Err(Refused::AnswerTooLarge { bytes, limit }),
            _ => Ok((message, outcome)),
        });
        match bounded {
            Ok((message, outcome)) => {
                call.note(|facts| {
                    facts.outcome = Some(outcome);
                    facts.code = Some(Code::Ok);
                });
                Ok(Response::new(message))
            }
            Err(refused) => {
                call.refused(&refused);
                Err(refused.to_status())
            }
        }
    }
}

fn call_of<T>(request: &Request<T>) -> Arc<Call> {
    request.extensions().get::<Arc<Call>>().cloned().unwrap_or_else(|| Arc::new(Call::new(Protocol::Grpc)))
}

fn plan(
    config: &Config,
    engines: &dyn Engines,
    call: &Call,
    request: PlanRapidMoveRequest,
    budget: &Budget,
) -> Result<(PlanRapidMoveResponse, &'static str), Refused> {
    let question = PlanQuestion::from_wire(request, &config.limits, budget)?;
    call.note(|facts| size_of(facts, &question.scene));
    // One expanded node is enough to learn whether the ends are free, and not enough to search.
    let iterations = if question.validate_only { Some(1) } else { question.iteration_limit };
    let budget = Budget { iterations, ..budget.clone() };
    let prepare = call.arrival.elapsed();
    let search_began = Instant::now();
    let planned = engines.plan_rapid_move(&question.scene, &question.query, &budget);
    let search = search_began.elapsed();
    match planned {
        Ok(_) if question.validate_only => Ok((sound_answer(), "valid")),
        Ok((answer, stats)) => {
            let outcome = match &answer {
                Answer::Plan(_) => "plan",
                Answer::NoPath(_) => "no_path",
            };
            Ok((plan_answer(&answer, stats, prepare, search), outcome))
        }
        Err(refusals) => match Refused::by_planner(refusals) {
            Some(Refused::IterationLimitReached { .. }) if question.validate_only => {
                Ok((sound_answer(), "valid"))
            }
            Some(refused) => Err(refused),
            None => Err(crate::fault::of("the planner refused without a reason")),
        },
    }
}

fn check(
    config: &Config,
    engines: &dyn Engines,
    call: &Call,
    request: CheckRapidMoveRequest,
    budget: &Budget,
) -> Result<(CheckRapidMoveResponse, &'static str), Refused> {
    let question = CheckQuestion::from_wire(request, &config.limits, budget)?;
    call.note(|facts| size_of(facts, &question.scene));
    let found = engines
        .check_rapid_move(&question, budget)
        .ok_or_else(|| Refused::interrupted(budget.check(0).err().unwrap_or(Interrupt::Deadline), None))?;
    let outcome = if found.violations.is_empty() { "sound" } else { "violations" };
    Ok((check_answer(&found), outcome))
}

pub(crate) fn size_of(facts: &mut Facts, scene: &Scene) {
    facts.vertices = scene.vertex_count();
    facts.obstacles = scene.obstacles.len();
}
