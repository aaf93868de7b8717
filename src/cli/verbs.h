// The verbs of the command line as a whole: examples for each, and what to say of an unknown one,
// or of an unknown option.
#pragma once

#include <span>
#include <string>

namespace CLI {
class App;
}

namespace drover::cli {

/// Ends the help of each verb with command lines of its own.
void add_examples(CLI::App& app);

/// The first option of a command line that its verb does not know, and what may be meant; empty
/// when all are known. It looks as far as the verbs are known.
std::string unknown_option(const CLI::App& app, std::span<const char* const> arguments);

/// What is wrong with the verbs of a command line, and what may be meant; empty when they are known
/// or none is given.
std::string unknown_verb(const CLI::App& app, std::span<const char* const> arguments);

/// Of a command line whose verbs and options are known: which verb `why` is about, and where help
/// is; or the verbs that there are where one is missing.
std::string incomplete(const CLI::App& app, std::span<const char* const> arguments,
                       const std::string& why);

}  // namespace drover::cli
