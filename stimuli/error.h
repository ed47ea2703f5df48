// What goes wrong outside the program: the two exceptions that every stage throws and only main catches.
// A bug is an assert, an expected outcome is a value; neither belongs here.
#pragma once

#include <stdexcept>
#include <string>

namespace stairstep {

/// An error a user can act on, in three parts that make its one line:
/// `error: <subject>: <problem>: <remedy>`.
class Error : public std::runtime_error {
  public:
    /// 1: it could not be done here (disk full, no GL context) · 2: wrong usage or bad input.
    int exit_code() const { return exit_code_; }

  protected:
    Error(int exit_code, const std::string& subject, const std::string& problem, const std::string& remedy)
        : std::runtime_error(subject + ": " + problem + ": " + remedy), exit_code_(exit_code) {}

  private:
    int exit_code_;
};

/// A command line, file or parameter that can't be accepted. Exit code 2.
class InputError : public Error {
  public:
    /// `subject` names what was read (a file, a flag), `problem` what is wrong with it, `remedy` what would do.
    InputError(const std::string& subject, const std::string& problem, const std::string& remedy)
        : Error(2, subject, problem, remedy) {}
};

/// The input was fine but the environment, or the data, would not allow the result. Exit code 1.
class FailureError : public Error {
  public:
    FailureError(const std::string& subject, const std::string& problem, const std::string& remedy)
        : Error(1, subject, problem, remedy) {}
};

}  // namespace stairstep
