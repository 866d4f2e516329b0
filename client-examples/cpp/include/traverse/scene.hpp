// What is in the way, as the service wants it: millimetres, x to the right, y up.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "traverse/v1/rapid.pb.h"

namespace traverse_client {

inline traverse::v1::Point point(double x_mm, double y_mm) {
  traverse::v1::Point made;
  made.set_x_mm(x_mm);
  made.set_y_mm(y_mm);
  return made;
}

// Straight edges through points; the first is not repeated.
inline traverse::v1::Ring polygon_ring(std::initializer_list<std::pair<double, double>> vertices_mm) {
  traverse::v1::Ring ring;
  for (const auto& [x_mm, y_mm] : vertices_mm) {
    ring.add_xy_mm(x_mm);
    ring.add_xy_mm(y_mm);
  }
  return ring;
}

// From its lower left corner.
inline traverse::v1::Ring rectangle(double x_mm, double y_mm, double width_mm, double height_mm) {
  const double right = x_mm + width_mm;
  const double top = y_mm + height_mm;
  return polygon_ring({{x_mm, y_mm}, {right, y_mm}, {right, top}, {x_mm, top}});
}

// Two half circles, each with bulge tan(π / 4) = 1, as in a DXF polyline: exact.
inline traverse::v1::Ring disc(double x_mm, double y_mm, double radius_mm) {
  traverse::v1::Ring ring = polygon_ring({{x_mm - radius_mm, y_mm}, {x_mm + radius_mm, y_mm}});
  ring.add_bulges(1);
  ring.add_bulges(1);
  return ring;
}

// An obstacle less its holes. The id is unique in the scene; answers name obstacles by it.
inline traverse::v1::Obstacle obstacle(std::string id, traverse::v1::Ring outer,
                                       std::initializer_list<traverse::v1::Ring> holes = {}) {
  traverse::v1::Obstacle made;
  made.set_id(std::move(id));
  *made.mutable_shape()->mutable_outer() = std::move(outer);
  for (const traverse::v1::Ring& hole : holes) *made.mutable_shape()->add_holes() = hole;
  return made;
}

// clearance_mm: what the tool's centre keeps from every obstacle, tool radius plus margin.
inline traverse::v1::Scene scene(std::initializer_list<traverse::v1::Obstacle> obstacles, double clearance_mm) {
  traverse::v1::Scene made;
  for (const traverse::v1::Obstacle& each : obstacles) *made.add_obstacles() = each;
  made.set_clearance_mm(clearance_mm);
  made.set_corner_style(traverse::v1::CORNER_STYLE_ROUND);
  return made;
}

}  // namespace traverse_client
