// Plans one rapid move round a plate with a disc beside it and a box, and prints the way.

#include <chrono>
#include <iostream>

#include "traverse/client.hpp"
#include "traverse/command_line.hpp"
#include "traverse/exit_code.hpp"
#include "traverse/report.hpp"
#include "traverse/scene.hpp"

namespace {

using namespace traverse_client;

constexpr const char* kUsage = "plan_rapid_move HOST:PORT FROM_X FROM_Y TO_X TO_Y [SECONDS]";

traverse::v1::Scene table() {
  const auto box = obstacle("box", rectangle(100, 0, 60, 60), {rectangle(105, 5, 50, 50)});
  return scene({obstacle("plate", rectangle(0, 0, 60, 40)), obstacle("boss", disc(75, 30, 10)), box}, 3);
}

int plan(const CommandLine& words) {
  traverse::v1::PlanRapidMoveRequest request;
  *request.mutable_scene() = table();
  *request.mutable_start() = point(words.number(1), words.number(2));
  *request.mutable_target() = point(words.number(3), words.number(4));
  const auto patience = words.patience(5, std::chrono::seconds{5});

  traverse::v1::PlanRapidMoveResponse response;
  const grpc::Status status = Client{words.word(0)}.plan_rapid_move(request, response, patience);
  if (!status.ok()) return print(std::cout, status);
  if (response.has_no_path()) {
    print(std::cout, response.no_path());
    return kNoPath;
  }
  print(std::cout, response.plan());
  return kDone;
}

}  // namespace

int main(int count, char** words) { return run({count, words}, 5, 6, kUsage, plan); }
