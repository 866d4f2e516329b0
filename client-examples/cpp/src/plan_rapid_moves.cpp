// Plans many rapid moves in one scene that changes as the program goes on, and prints what came of each step as soon as
// it is known. The steps are a file of JSON, one per line: a scene, then queries and edits in program order.
//
// A step that is refused is told, and the session goes on; the exit code counts only whether it came to its end.

#include <chrono>
#include <cstddef>
#include <iostream>
#include <vector>

#include "traverse/client.hpp"
#include "traverse/command_line.hpp"
#include "traverse/exit_code.hpp"
#include "traverse/json_file.hpp"
#include "traverse/refusal.hpp"
#include "traverse/report.hpp"
#include "traverse/session.hpp"

namespace {

using namespace traverse_client;

constexpr const char* kUsage = "plan_rapid_moves HOST:PORT STEPS.jsonl [SECONDS]";

void print_outcome(const Session::Answer& answer) {
  switch (answer.outcome_case()) {
    case Session::Answer::kPlan:
      return print(std::cout, answer.plan());
    case Session::Answer::kNoPath:
      return print(std::cout, answer.no_path());
    case Session::Answer::kSceneChanged:
      std::cout << "the scene holds " << answer.scene_changed().obstacle_count() << " obstacles now\n";
      return;
    case Session::Answer::kProblem:
      return print(std::cout, refusal(answer.problem()));
    case Session::Answer::OUTCOME_NOT_SET:
      break;
  }
  std::cout << "answered with what this client does not know: generate it anew\n";
}

int plan(const CommandLine& words) {
  const auto steps = steps_from<Session::Step>(words.word(1));
  const auto patience = words.patience(2, std::chrono::seconds{60});

  std::size_t answered = 0;
  const auto told = [&](std::size_t place, const Session::Answer& answer) {
    const Session::Step& step = steps[place];
    ++answered;
    if (step.step_id().empty())
      std::cout << "step " << place + 1;
    else
      std::cout << step.step_id();
    std::cout << ": ";
    print_outcome(answer);
    std::cout << std::flush;
  };
  const grpc::Status status = Client{words.word(0)}.plan_rapid_moves(steps, told, patience);
  if (status.ok()) return kDone;
  std::cout << "of " << steps.size() << " steps " << answered << " were answered\n";
  return print(std::cout, status);
}

}  // namespace

int main(int count, char** words) { return run({count, words}, 2, 3, kUsage, plan); }
