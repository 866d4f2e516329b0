// A session (PlanRapidMoves): the scene once, then moves and edits in program order, sent ahead of their answers.
#pragma once

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "traverse/v1/service.grpc.pb.h"

namespace traverse_client {

// One open session. A thread of its own sends the steps while you read the answers. Reading never waits for sending, and
// a server reads on once its answers are read: so neither side can hold up the other for good.
class Session {
 public:
  using Step = traverse::v1::PlanRapidMovesRequest;
  using Answer = traverse::v1::PlanRapidMovesResponse;

  // Stub, context and steps outlive the session. context.TryCancel(), from any thread, ends it.
  Session(traverse::v1::PlannerService::Stub& stub, grpc::ClientContext& context, const std::vector<Step>& steps)
      : context_(context), steps_(steps), stream_(stub.PlanRapidMoves(&context)), sender_([this] { send(); }) {}

  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Before finish(): nobody reads any more, so the session is given up.
  ~Session() {
    if (!sender_.joinable()) return;
    context_.TryCancel();
    move([this] { over_ = true; });
    sender_.join();
  }

  // Reads the next answer, and returns the place of its step. None: the session is over, and finish() says why.
  std::optional<std::size_t> next(Answer& answer) {
    const bool read = stream_->Read(&answer);
    const std::size_t place = answered_;
    strayed_ = read && (place == steps_.size() || !answers(answer, steps_[place]));
    if (read && !strayed_) {
      move([this] { ++answered_; });
      return place;
    }
    move([this] { over_ = true; });
    return std::nullopt;
  }

  // How the session ended: well only when every step was answered. Once, when next() has returned none.
  grpc::Status finish() {
    if (strayed_) context_.TryCancel();
    sender_.join();
    const grpc::Status status = stream_->Finish();
    if (strayed_) return {grpc::StatusCode::INTERNAL, "an answer names another step than the one that is due"};
    if (status.ok() && answered_ < steps_.size())
      return {grpc::StatusCode::INTERNAL, "the session ended well, and steps are not answered"};
    return status;
  }

 private:
  static constexpr std::size_t kStepIdBytes = 256;

  // Steps that are sent ahead of their answers. Enough to keep the server busy; thousands of small frames that wait to be
  // read can cost the connection, however much room its windows have.
  static constexpr std::size_t kAhead = 256;

  // Answers come in the order of the steps and repeat their ids; an id that is too long is refused, and shortened.
  static bool answers(const Answer& answer, const Step& step) {
    return answer.step_id() == step.step_id() || step.step_id().size() > kStepIdBytes;
  }

  void send() {
    for (std::size_t place = 0; place < steps_.size(); ++place)
      if (!may_send(place) || !stream_->Write(steps_[place])) return;  // the session is over
    stream_->WritesDone();
  }

  // Waits until the step's turn has come; false: the session is over.
  bool may_send(std::size_t place) {
    std::unique_lock<std::mutex> lock{mutex_};
    moved_.wait(lock, [&] { return over_ || place < answered_ + kAhead; });
    return !over_;
  }

  // Tells the sender of a change.
  template <typename Change>
  void move(const Change& change) {
    {
      const std::lock_guard<std::mutex> lock{mutex_};
      change();
    }
    moved_.notify_one();
  }

  grpc::ClientContext& context_;
  const std::vector<Step>& steps_;
  std::unique_ptr<grpc::ClientReaderWriter<Step, Answer>> stream_;
  bool strayed_ = false;
  std::mutex mutex_;  // of what both threads look at; only the reader changes it
  std::condition_variable moved_;
  std::size_t answered_ = 0;
  bool over_ = false;
  std::thread sender_;  // last: it uses the others
};

}  // namespace traverse_client
