// Plans one rapid move round a plate with a disc beside it and a box, and prints the way.
//
// plan_rapid_move HOST:PORT FROM_X FROM_Y TO_X TO_Y [SECONDS]

#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string>

#include "traverse/client.hpp"
#include "traverse/refusal.hpp"
#include "traverse/scene.hpp"

namespace {

// As the traverse program ends.
enum ExitCode {
  kDone = 0,
  kInternal = 1,
  kWrongCommandLine = 2,
  kRefused = 3,
  kNoPath = 4,
  kNotReachable = 6,
  kNotNow = 7,
};

traverse::v1::Scene table() {
  using namespace traverse_client;
  const auto box = obstacle("box", rectangle(100, 0, 60, 60), {rectangle(105, 5, 50, 50)});
  return scene({obstacle("plate", rectangle(0, 0, 60, 40)), obstacle("boss", disc(75, 30, 10)), box}, 3);
}

template <typename Ids>
std::string joined(const Ids& ids) {
  std::string text;
  for (const std::string& id : ids) text += (text.empty() ? "" : ", ") + id;
  return text;
}

void print(const traverse::v1::RapidPlan& plan) {
  std::cout << std::fixed << std::setprecision(3) << plan.cost() << " mm, proven not to be shorter than "
            << plan.lower_bound() << " mm\nround " << joined(plan.bending_obstacle_ids()) << "\n"
            << std::setprecision(4);
  for (const traverse::v1::PathStep& step : plan.path().steps()) {
    const char* code = !step.has_arc() ? "G0" : step.arc().clockwise() ? "G2" : "G3";
    std::cout << "  " << code << " X" << step.end().x_mm() << " Y" << step.end().y_mm();
    if (step.has_arc())
      std::cout << " about (" << step.arc().center().x_mm() << ", " << step.arc().center().y_mm() << ")";
    std::cout << "\n";
  }
}

int print(const grpc::Status& status) {
  const traverse_client::Refusal refusal = traverse_client::refusal(status);
  std::cout << "refused: " << refusal.reason << (refusal.reason.empty() ? "" : ": ") << refusal.message << "\n";
  for (const traverse_client::Finding& finding : refusal.findings)
    std::cout << "  " << finding.field << ": " << finding.description << " (" << finding.reason << ")\n";
  switch (status.error_code()) {
    case grpc::StatusCode::INVALID_ARGUMENT:
      return kRefused;
    case grpc::StatusCode::UNAVAILABLE:
      return kNotReachable;
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return kNotNow;
    default:
      return kInternal;
  }
}

int plan(int count, char** arguments) {
  if (count < 6 || count > 7) throw std::invalid_argument("wrong count of arguments");
  const auto number = [&](int i) { return std::stod(arguments[i]); };
  traverse::v1::PlanRapidMoveRequest request;
  *request.mutable_scene() = table();
  *request.mutable_start() = traverse_client::point(number(2), number(3));
  *request.mutable_target() = traverse_client::point(number(4), number(5));
  const std::chrono::milliseconds patience{std::lround(1000 * (count == 7 ? number(6) : 5))};

  const traverse_client::Client client{arguments[1]};
  traverse::v1::PlanRapidMoveResponse response;
  const grpc::Status status = client.plan_rapid_move(request, response, patience);
  if (!status.ok()) return print(status);
  if (response.has_plan()) {
    print(response.plan());
    return kDone;
  }
  // An answer, not an error: no tool can get there.
  std::cout << "there is no way: " << joined(response.no_path().separating_obstacle_ids())
            << " part start from target\n";
  return kNoPath;
}

}  // namespace

int main(int count, char** arguments) try {
  return plan(count, arguments);
} catch (const std::logic_error& error) {  // std::stod throws these, too
  std::cerr << error.what() << "\nusage: plan_rapid_move HOST:PORT FROM_X FROM_Y TO_X TO_Y [SECONDS]\n";
  return kWrongCommandLine;
}
