// How the programs end: as the traverse program does, see docs/cli.md.
#pragma once

#include <grpcpp/grpcpp.h>

#include <stdexcept>
#include <string>

#include "traverse/refusal.hpp"

namespace traverse_client {

enum ExitCode {
  kDone = 0,
  kInternal = 1,
  kWrongCommandLine = 2,
  kRefused = 3,
  kNoPath = 4,
  kNotReachable = 6,
  kNotNow = 7,
};

// A program that can't go on.
struct Failure : std::runtime_error {
  Failure(ExitCode ends_with, const std::string& why) : std::runtime_error(why), code(ends_with) {}
  ExitCode code;
};

// Of a call that failed.
inline ExitCode exit_code(const grpc::Status& status) {
  const std::string reason = refusal(status).reason;
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      return reason.empty() ? kNotReachable : kNotNow;  // without a reason it was not Traverse that answered
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::CANCELLED:
      return kNotNow;
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      // What is too large stays so, and so does a search that a limit ends.
      return reason.empty() || reason == "QUEUE_FULL" ? kNotNow : kRefused;
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::DATA_LOSS:
      return kInternal;
    default:
      return kRefused;
  }
}

}  // namespace traverse_client
