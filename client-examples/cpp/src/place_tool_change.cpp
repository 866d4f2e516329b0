// Finds the best place for a tool change, and prints it and the moves to it and on from it. The request is a file of
// JSON, such as `traverse tool-change … --request FILE` writes.

#include <chrono>
#include <iomanip>
#include <iostream>

#include "traverse/client.hpp"
#include "traverse/command_line.hpp"
#include "traverse/exit_code.hpp"
#include "traverse/json_file.hpp"
#include "traverse/report.hpp"

namespace {

using namespace traverse_client;

constexpr const char* kUsage = "place_tool_change HOST:PORT REQUEST.json [SECONDS]";

void print_change(const traverse::v1::ToolChangePlan& plan) {
  std::cout << std::fixed << std::setprecision(4) << "change at ";
  print(std::cout, plan.place());
  std::cout << "\n";
  print_cost(std::cout, plan);
  std::cout << "to it: ";
  print(std::cout, plan.approach());
  std::cout << "on from it: ";
  print(std::cout, plan.departure());
}

int place(const CommandLine& words) {
  const auto request = request_from<traverse::v1::PlaceToolChangeRequest>(words.word(1));
  const auto patience = words.patience(2, std::chrono::seconds{5});

  traverse::v1::PlaceToolChangeResponse response;
  const grpc::Status status = Client{words.word(0)}.place_tool_change(request, response, patience);
  if (!status.ok()) return print(std::cout, status);
  switch (response.outcome_case()) {
    case traverse::v1::PlaceToolChangeResponse::kPlan:
      print_change(response.plan());
      return kDone;
    case traverse::v1::PlaceToolChangeResponse::kNoPath:
      std::cout << "no permitted place: ";
      print(std::cout, response.no_path());
      return kNoPath;
    case traverse::v1::PlaceToolChangeResponse::OUTCOME_NOT_SET:  // validate_only
      break;
  }
  std::cout << "the request is sound\n";
  return kDone;
}

}  // namespace

int main(int count, char** words) { return run({count, words}, 2, 3, kUsage, place); }
