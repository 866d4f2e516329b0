// When a call is tried again: when the server can't be reached (UNAVAILABLE), and where it says when (RetryInfo, such
// as with a full queue). Nothing else gets better by being repeated.
#pragma once

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "traverse/refusal.hpp"

namespace traverse_client {

namespace detail {

// A random part of the pause, so that clients that were cut off together do not come back together.
inline std::chrono::milliseconds with_jitter(std::chrono::milliseconds pause) {
  thread_local std::mt19937 random{std::random_device{}()};
  return std::chrono::milliseconds{std::uniform_int_distribution<long>{pause.count() / 2, pause.count()}(random)};
}

}  // namespace detail

// The status of the last try of `call` (grpc::ClientContext&) -> grpc::Status, all of them within patience.
// `repeatable` () -> bool is asked after one that failed: whether nothing came of it yet.
template <typename Call, typename Repeatable>
grpc::Status with_retries(grpc::Channel& channel, std::chrono::milliseconds patience, const Call& call,
                          const Repeatable& repeatable) {
  using Clock = std::chrono::system_clock;  // what gRPC takes deadlines in
  constexpr std::chrono::milliseconds no_delay{0};
  constexpr std::chrono::milliseconds longest_pause{2000};
  const Clock::time_point deadline = Clock::now() + patience;
  for (std::chrono::milliseconds pause{100};; pause = std::min(2 * pause, longest_pause)) {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    const grpc::Status status = call(context);
    if (status.ok() || !repeatable()) return status;
    const auto asked = refusal(status).retry_after;
    // Compared before it is added: a delay of years is no time that the clock has.
    if ((status.error_code() != grpc::StatusCode::UNAVAILABLE && !asked) || asked.value_or(no_delay) >= patience)
      return status;
    const Clock::time_point next = Clock::now() + asked.value_or(no_delay) + detail::with_jitter(pause);
    if (next >= deadline) return status;
    // A channel makes headway only while somebody waits on it: in mere sleep every connection would time out half made.
    channel.WaitForConnected(next);
    std::this_thread::sleep_until(next);
  }
}

}  // namespace traverse_client
