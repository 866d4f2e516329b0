// What came of a call, as text.
#pragma once

#include <grpcpp/grpcpp.h>

#include <iomanip>
#include <ostream>
#include <string>

#include "traverse/exit_code.hpp"
#include "traverse/refusal.hpp"
#include "traverse/v1/rapid.pb.h"

namespace traverse_client {

namespace detail {

template <typename Ids>
std::string joined(const Ids& ids) {
  std::string text;
  for (const std::string& id : ids) text += (text.empty() ? "" : ", ") + id;
  return text;
}

}  // namespace detail

// Of any plan: what it costs, and the bound.
template <typename Plan>
void print_cost(std::ostream& out, const Plan& plan) {
  const char* unit = plan.cost_unit() == traverse::v1::COST_UNIT_SECONDS ? " s" : " mm";
  out << std::fixed << std::setprecision(3) << plan.cost() << unit << ", proven that none is below "
      << plan.lower_bound() << unit << "\n";
}

inline void print(std::ostream& out, const traverse::v1::Point& point) {
  out << "X" << point.x_mm() << " Y" << point.y_mm();
}

inline void print(std::ostream& out, const traverse::v1::PathStep& step) {
  out << (!step.has_arc() ? "  G0 " : step.arc().clockwise() ? "  G2 " : "  G3 ") << std::fixed << std::setprecision(4);
  print(out, step.end());
  if (step.has_z_mm()) out << " Z" << step.z_mm();
  if (step.has_arc()) out << " about (" << step.arc().center().x_mm() << ", " << step.arc().center().y_mm() << ")";
  out << "\n";
}

inline void print(std::ostream& out, const traverse::v1::RapidPlan& plan) {
  print_cost(out, plan);
  const std::string bending = detail::joined(plan.bending_obstacle_ids());
  if (!bending.empty()) out << "round " << bending << "\n";
  for (const traverse::v1::PathStep& step : plan.path().steps()) print(out, step);
}

// An answer, not an error: no tool can get there.
inline void print(std::ostream& out, const traverse::v1::NoPath& no_path) {
  const std::string parting = detail::joined(no_path.separating_obstacle_ids());
  out << "there is no way because of " << (parting.empty() ? "the work area's border" : parting) << "\n";
  if (no_path.has_feasible_clearance_mm())
    out << std::fixed << std::setprecision(4) << "  at clearance " << no_path.feasible_clearance_mm() << " there is one\n";
}

inline void print(std::ostream& out, const Refusal& refusal) {
  out << "refused: " << refusal.reason << (refusal.reason.empty() ? "" : ": ") << refusal.message << "\n";
  for (const Finding& finding : refusal.findings)
    out << "  " << finding.field << ": " << finding.description << " (" << finding.reason << ")\n";
}

// Of a call that failed; returns what to end with.
inline ExitCode print(std::ostream& out, const grpc::Status& status) {
  print(out, refusal(status));
  return exit_code(status);
}

}  // namespace traverse_client
