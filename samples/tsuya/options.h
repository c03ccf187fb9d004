#pragma once
/// \file
/// What a command asks of its user. A command declares its options with the fields that they fill;
/// parse_call (command.h) takes the words of a call apart.
///
///     void options(Options &o) override {
///         o.argument(&scene, "SCENE.toml", "scene file").required();
///         o.option("--spp", &samples, "N", "samples per pixel").range(1, 65536);
///         o.example("tsuya render dress.scene.toml -o dress.exr --spp 128");
///     }

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tsuya/sdk/error.h"

namespace tsuya::program {

/// Thrown for words that are no call of the program.
class WrongCall : public Error {
  public:
    using Error::Error;
};

/// The field that an option fills. What it holds before is the default.
using Field = std::variant<bool *, int *, std::uint32_t *, std::uint64_t *, double *, std::string *,
                           std::filesystem::path *, std::optional<int> *,
                           std::optional<std::uint32_t> *, std::optional<double> *,
                           std::optional<std::string> *, std::vector<int> *, std::vector<double> *,
                           std::vector<std::string> *, std::vector<std::filesystem::path> *>;

/// One option: its rules, and after parsing the words that were given for it.
struct Option {
    std::string names; ///< `-o,--output`; empty for an argument, which has its place alone
    Field field;
    std::string value; ///< stands for the value in the help: `OUT.exr`
    std::string help;  ///< what the value is

    Option &required();
    /// The numbers that are accepted; the first one is not where `open` is set.
    Option &range(double least, double most, bool open = false);
    Option &positive() { return range(0, std::numeric_limits<double>::infinity(), true); }
    /// The only values that are accepted; beside files, where or_file() is set.
    Option &one_of(std::vector<std::string> values);
    /// A list whose values may stand in one word, with commas between.
    Option &with_commas();
    /// A list whose values are all words up to the next option, as a shell's `*` gives them.
    Option &with_words();
    /// As many values, no more and no fewer.
    Option &exactly(std::size_t count);
    /// A file that the command writes: it must not be one that the call reads, nor another result.
    /// Its name ends in one of the extensions (such as `.png`), where some are given.
    Option &result(std::vector<std::string> extensions = {});
    /// A text that may also be the name of a file that is read. Beside the values of one_of(), a
    /// word with an extension, or of a file that exists, is one.
    Option &or_file();
    /// A rule of the command's own, for what no input could make right. It is called when all
    /// fields are filled, also where the option is not given, and throws Error, whose problems are
    /// reported at this option as a wrong call.
    Option &check(std::function<void()> rule);
    Option &needs(const Option &other);
    Option &excludes(const Option &other);

    bool given = false;
    std::vector<std::string> words{};
    std::string called{}; ///< the long name in the call, of several; may be empty

    bool is_required = false, has_commas = false, has_words = false, is_open = false;
    bool is_result = false, may_be_file = false;
    std::optional<double> least{}, most{};
    std::optional<std::size_t> count{};
    std::vector<std::string> choices{}, extensions{};
    std::vector<std::function<void()>> rules{};
    std::vector<const Option *> needed{}, excluded{};
};

/// The options of a command, in the order of its help.
class Options {
  public:
    Option &argument(Field field, std::string value, std::string help);
    Option &option(std::string names, Field field, std::string value, std::string help);
    Option &flag(std::string names, bool *field, std::string help);
    /// Of two options, one must be given and one alone.
    void one_of(Option &first, Option &second);
    /// An example of a call for the help, several with line breaks between them.
    void example(std::string text) { example_ = std::move(text); }
    /// What the help says after the example.
    void notes(std::string text) { notes_ = std::move(text); }

    std::deque<Option> &all() { return all_; }
    const std::deque<Option> &all() const { return all_; }
    const std::string &example() const { return example_; }
    const std::string &notes() const { return notes_; }

    /// Puts the words that were given into the fields. Throws WrongCall for what breaks the rules
    /// of the options: one that is missing or must not be given, a word that is no such value, a
    /// result that would replace a file that is read or has another extension, a value that a
    /// command's own rule refuses.
    void fill_fields() const;

  private:
    std::deque<Option> all_{}; // addresses stay
    std::vector<std::pair<const Option *, const Option *>> one_of_{};
    std::string example_{}, notes_{};
};

/// How messages call an option: `--output`, or `OUT.exr` for an argument.
std::string name_of(const Option &option);

/// The values that an option accepts: `a whole number from 1 to 65536`; empty where any is.
std::string accepted_by(const Option &option);

/// The same in short for the help: `1 to 65536`.
std::string range_of(const Option &option);

/// The default as it would be typed; empty where there is none.
std::string default_of(const Option &option);

bool is_flag(const Option &option);
bool is_list(const Option &option);

} // namespace tsuya::program
