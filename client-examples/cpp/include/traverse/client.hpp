// Calls with a deadline, tried again where that helps.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "traverse/retry.hpp"
#include "traverse/session.hpp"
#include "traverse/v1/service.grpc.pb.h"

namespace traverse_client {

// Connects with the first call, and again when the connection broke. Safe to use from several threads.
//
// Every call ends within patience, tries included. The server stops in time by itself and answers shortly before.
class Client {
 public:
  // address: host:port. For TLS pass grpc::SslCredentials.
  explicit Client(const std::string& address,
                  const std::shared_ptr<grpc::ChannelCredentials>& credentials = grpc::InsecureChannelCredentials())
      : channel_(grpc::CreateCustomChannel(address, credentials, channel_arguments())),
        stub_(traverse::v1::PlannerService::NewStub(channel_)) {}

  // The shortest collision-free rapid move.
  grpc::Status plan_rapid_move(const traverse::v1::PlanRapidMoveRequest& request,
                               traverse::v1::PlanRapidMoveResponse& response,
                               std::chrono::milliseconds patience) const {
    return unary(&Stub::PlanRapidMove, request, response, patience);
  }

  // The best place for a tool change.
  grpc::Status place_tool_change(const traverse::v1::PlaceToolChangeRequest& request,
                                 traverse::v1::PlaceToolChangeResponse& response,
                                 std::chrono::milliseconds patience) const {
    return unary(&Stub::PlaceToolChange, request, response, patience);
  }

  // A whole session: hands each answer and the place of its step to `told` (std::size_t, const Session::Answer&), in
  // order and as soon as it is there. Once there is an answer the session is not tried again: what failed then is for
  // the caller to know.
  template <typename Told>
  grpc::Status plan_rapid_moves(const std::vector<Session::Step>& steps, const Told& told,
                                std::chrono::milliseconds patience) const {
    bool answered = false;
    const auto once = [&](grpc::ClientContext& context) {
      Session session{*stub_, context, steps};
      Session::Answer answer;
      while (const auto step = session.next(answer)) {
        answered = true;
        told(*step, answer);
      }
      return session.finish();
    };
    return with_retries(*channel_, patience, once, [&] { return !answered; });
  }

 private:
  using Stub = traverse::v1::PlannerService::Stub;

  template <typename Request, typename Response>
  grpc::Status unary(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                     const Request& request, Response& response, std::chrono::milliseconds patience) const {
    const auto once = [&](grpc::ClientContext& context) { return (*stub_.*method)(&context, request, &response); };
    return with_retries(*channel_, patience, once, [] { return true; });
  }

  static grpc::ChannelArguments channel_arguments() {
    grpc::ChannelArguments arguments;
    // A server limits what it answers (GetLimits.message_bytes); gRPC's own 4 MiB is less.
    arguments.SetMaxReceiveMessageSize(64 << 20);
    // When to try again is decided by with_retries; the channel has to be ready to connect by then.
    arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
    arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
    arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 100);
    arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
    return arguments;
  }

  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<Stub> stub_;
};

}  // namespace traverse_client
