// Calls with a deadline, tried again when the server can't be reached (UNAVAILABLE), and where it says when (RetryInfo, such as
// with a full queue). Nothing else gets better by being repeated.
#pragma once

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <string>
#include <thread>

#include "traverse/refusal.hpp"
#include "traverse/v1/service.grpc.pb.h"

namespace traverse_client {

// Connects with the first call, and again when the connection broke. Safe to use from several threads.
class Client {
 public:
  using Clock = std::chrono::system_clock;  // what gRPC takes deadlines in

  // address: host:port. For TLS pass grpc::SslCredentials.
  explicit Client(const std::string& address,
                  const std::shared_ptr<grpc::ChannelCredentials>& credentials = grpc::InsecureChannelCredentials())
      : channel_(grpc::CreateCustomChannel(address, credentials, channel_arguments())),
        stub_(traverse::v1::PlannerService::NewStub(channel_)) {}

  // The shortest collision-free rapid move, tries included within patience. The server stops in time by itself and
  // answers shortly before.
  grpc::Status plan_rapid_move(const traverse::v1::PlanRapidMoveRequest& request,
                               traverse::v1::PlanRapidMoveResponse& response,
                               std::chrono::milliseconds patience) const {
    const Clock::time_point deadline = Clock::now() + patience;
    for (std::chrono::milliseconds pause = kFirstPause;; pause = std::min(2 * pause, kLongestPause)) {
      grpc::ClientContext context;
      context.set_deadline(deadline);
      const grpc::Status status = stub_->PlanRapidMove(&context, request, &response);
      if (status.ok()) return status;
      const auto asked = refusal(status).retry_after;
      // Compared before it is added: a delay of years is no time that the clock has.
      if ((status.error_code() != grpc::StatusCode::UNAVAILABLE && !asked) || asked.value_or(kNoDelay) >= patience)
        return status;
      const Clock::time_point next = Clock::now() + asked.value_or(kNoDelay) + with_jitter(pause);
      if (next >= deadline) return status;
      // A channel makes headway only while somebody waits on it: in mere sleep every connection would time out half made.
      channel_->WaitForConnected(next);
      std::this_thread::sleep_until(next);
    }
  }

 private:
  static constexpr std::chrono::milliseconds kNoDelay{0};
  static constexpr std::chrono::milliseconds kFirstPause{100};
  static constexpr std::chrono::milliseconds kLongestPause{2000};

  static grpc::ChannelArguments channel_arguments() {
    grpc::ChannelArguments arguments;
    // A server limits what it answers (GetLimits.message_bytes); gRPC's own 4 MiB is less.
    arguments.SetMaxReceiveMessageSize(64 << 20);
    // When to try again is decided above; the channel has to be ready to connect by then.
    arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
    arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
    arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 100);
    arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
    return arguments;
  }

  // A random part of the pause, so that clients that were cut off together do not come back together.
  static std::chrono::milliseconds with_jitter(std::chrono::milliseconds pause) {
    thread_local std::mt19937 random{std::random_device{}()};
    return std::chrono::milliseconds{std::uniform_int_distribution<long>{pause.count() / 2, pause.count()}(random)};
  }

  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<traverse::v1::PlannerService::Stub> stub_;
};

}  // namespace traverse_client
