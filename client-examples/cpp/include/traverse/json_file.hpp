// Requests from files, as `traverse call` takes them: proto3 JSON, for a session one step per line.
#pragma once

#include <google/protobuf/util/json_util.h>

#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "traverse/exit_code.hpp"

namespace traverse_client {

namespace detail {

inline std::string text_of(const std::string& file) {
  std::ifstream opened;
  if (file != "-") opened.open(file);
  std::istream& from = file == "-" ? std::cin : opened;
  std::ostringstream text;
  if (!(text << from.rdbuf())) throw Failure{kRefused, file + " can't be read, or is empty"};
  return text.str();
}

template <typename Message>
Message from_json(const std::string& text, const std::string& where) {
  Message message;
  const auto status = google::protobuf::util::JsonStringToMessage(text, &message);
  if (!status.ok())
    throw Failure{kRefused, where + ": no " + message.GetTypeName() + ": " + std::string{status.message()}};
  return message;
}

}  // namespace detail

// The one request of a file; `-` is standard input.
template <typename Request>
Request request_from(const std::string& file) {
  return detail::from_json<Request>(detail::text_of(file), file);
}

// The steps of a file. Empty lines are left out.
template <typename Step>
std::vector<Step> steps_from(const std::string& file) {
  std::istringstream lines{detail::text_of(file)};
  std::vector<Step> steps;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    if (line.find_first_not_of(" \t\r") != std::string::npos)
      steps.push_back(detail::from_json<Step>(line, file + ":" + std::to_string(number)));
  return steps;
}

}  // namespace traverse_client
