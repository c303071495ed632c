#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace vsgl {

// Declares `flag`, one of a registry's rows (each with `name` and `summary`), and --list-methods, which
// prints them one a line and has no place in a file. `registry` must outlive the app.
template <class Method>
void add_methods(CLI::App& app, const std::vector<Method>& registry, std::string& method,
                 const std::string& help, const std::string& flag = "--method") {
  std::vector<std::string> names;
  for (const Method& row : registry) names.push_back(row.name);
  app.add_option(flag, method, help + "; see --list-methods")->check(CLI::IsMember(names));
  const auto print = [&registry] {
    std::size_t widest = 0;
    for (const Method& row : registry) widest = std::max(widest, row.name.size());
    std::string text;
    for (const Method& row : registry)
      text += (text.empty() ? "" : "\n") + row.name + std::string(widest + 2 - row.name.size(), ' ') +
              row.summary;
    throw CLI::CallForVersion(text, 0);
  };
  app.add_flag_callback("--list-methods", print, "print the methods and exit")->configurable(false);
}

// Declares `flag`, one of a registry's rows, each of which its help explains.
template <class Row>
void add_choice(CLI::App& app, const std::string& flag, const std::vector<Row>& registry, std::string& choice,
                std::string help) {
  std::vector<std::string> names;
  for (const Row& row : registry) {
    help += (names.empty() ? ": " : "; ") + row.name + ": " + row.summary;
    names.push_back(row.name);
  }
  app.add_option(flag, choice, help)->check(CLI::IsMember(names));
}

}  // namespace vsgl
