// Why a call, or a step of a session, was refused: a reason for programs, and every finding with its field.
// docs/errors.md explains each reason.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "error_details.pb.h"
#include "traverse/v1/solve.pb.h"

namespace traverse_client {

// One thing that is wrong with a request.
struct Finding {
  std::string field;
  std::string description;
  std::string reason;
};

// What a status, or a session's problem, says.
struct Refusal {
  std::string reason;  // UPPER_SNAKE_CASE; empty when something else than Traverse answered
  std::string message;
  std::vector<Finding> findings;
  std::optional<std::chrono::milliseconds> retry_after;  // when the server says that trying again helps
};

namespace detail {

// Whether `any` holds the message of that name; reads it into `message` then.
template <typename Message>
bool unpack(const google::protobuf::Any& any, const std::string& name, Message& message) {
  const std::string& url = any.type_url();
  return url.substr(url.find_last_of('/') + 1) == name && message.ParseFromString(any.value());
}

}  // namespace detail

// Details that can't be read are left out.
inline Refusal refusal(const grpc::Status& status) {
  Refusal read;
  read.message = status.error_message();
  Status details;
  if (!details.ParseFromString(status.error_details())) return read;
  for (const google::protobuf::Any& any : details.details()) {
    ErrorInfo info;
    if (detail::unpack(any, "google.rpc.ErrorInfo", info)) read.reason = info.reason();
    RetryInfo retry;
    if (detail::unpack(any, "google.rpc.RetryInfo", retry))
      read.retry_after =
          std::chrono::seconds{retry.retry_delay().seconds()} +
          std::chrono::ceil<std::chrono::milliseconds>(std::chrono::nanoseconds{retry.retry_delay().nanos()});
    BadRequest request;
    if (!detail::unpack(any, "google.rpc.BadRequest", request)) continue;
    for (const auto& violation : request.field_violations())
      read.findings.push_back({violation.field(), violation.description(), violation.reason()});
  }
  return read;
}

// Of one step of a session, which goes on.
inline Refusal refusal(const traverse::v1::Problem& problem) {
  Refusal read;
  read.reason = problem.reason();
  read.message = problem.message();
  for (const auto& finding : problem.findings())
    read.findings.push_back({finding.field(), finding.message(), finding.reason()});
  return read;
}

}  // namespace traverse_client
