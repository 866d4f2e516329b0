// What a program is called with, and how it ends when that is wrong.
#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "traverse/exit_code.hpp"

namespace traverse_client {

// The words behind the program's name.
class CommandLine {
 public:
  CommandLine(int count, char** words) : words_(words + 1, words + count) {}

  std::size_t size() const { return words_.size(); }

  const std::string& word(std::size_t i) const { return words_.at(i); }

  // What std::stod reads, inf and nan included: the service says what is wrong with them.
  double number(std::size_t i) const {
    std::size_t read = 0;
    try {
      const double value = std::stod(word(i), &read);
      if (read == word(i).size()) return value;
    } catch (const std::logic_error&) {
    }
    throw Failure{kWrongCommandLine, word(i) + " is no number"};
  }

  // Seconds, at most a day; `otherwise` where the word is missing.
  std::chrono::milliseconds patience(std::size_t i, std::chrono::milliseconds otherwise) const {
    if (i >= size()) return otherwise;
    const double seconds = number(i);
    if (!(seconds >= 0 && seconds <= 86400))
      throw Failure{kWrongCommandLine, word(i) + " is not within 0 and 86400 seconds"};
    return std::chrono::milliseconds{std::lround(1000 * seconds)};
  }

 private:
  std::vector<std::string> words_;
};

// Runs a program that takes from `least` to `most` words.
template <typename Program>
int run(const CommandLine& words, std::size_t least, std::size_t most, const char* usage, const Program& program) try {
  if (words.size() < least || words.size() > most) throw Failure{kWrongCommandLine, "wrong count of arguments"};
  return program(words);
} catch (const Failure& failure) {
  std::cerr << failure.what() << "\n";
  if (failure.code == kWrongCommandLine) std::cerr << "usage: " << usage << "\n";
  return failure.code;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return kInternal;
}

}  // namespace traverse_client
