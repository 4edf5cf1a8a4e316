#include "cli/completion.h"

#include <fmt/format.h>

#include <string_view>

#include "cli/command.h"
#include "cli/command_tree.h"

namespace rastercheck::cli {
namespace {

/// Bash also splits words at ':' and '=', and replaces only the part after the last such character.
/// So the script joins words again, and cuts replies.
constexpr std::string_view kBegin =
    R"(# Bash completion for rastercheck, written by `rastercheck completion bash`.

# The words up to the cursor, split at spaces only.
_rastercheck_words() {
  local i word rest=$COMP_LINE after_space
  words=()
  for ((i = 0; i <= COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    after_space=${rest#"${rest%%[![:space:]]*}"}
    if ((i > 0)) && [[ $rest == "$after_space" && -n $rest ]]; then
      words[${#words[@]} - 1]+=$word
    else
      words+=("$word")
    fi
    rest=${after_space#"$word"}
  done
}

# The names of the backends that can run here, according to `list`.
_rastercheck_backends() {
  local name available rest
  [[ -n $_rastercheck_backends ]] ||
    _rastercheck_backends=$("$1" list backends --quiet 2>/dev/null </dev/null)
  while read -r name available rest; do
    [[ $available == true ]] && replies+=("$name")
  done <<<"$_rastercheck_backends"
  replies+=(plugin:)
}

_rastercheck_properties() {
  local name
  [[ -n $_rastercheck_properties ]] ||
    _rastercheck_properties=$("$1" list properties --quiet 2>/dev/null </dev/null)
  while read -r name _; do replies+=("$name"); done <<<"$_rastercheck_properties"
}

_rastercheck() {
  local words current previous command options values argument reply prefix
  local -a replies=()
  COMPREPLY=()
  _rastercheck_words
  current=${words[${#words[@]} - 1]}
  previous=${words[${#words[@]} - 2]}
  local program=${words[0]/#\~/$HOME}
  # --option=value
  if [[ $current == --*=* ]]; then
    previous=${current%%=*}
    current=${current#*=}
  fi
  command=
  ((${#words[@]} > 2)) && command=${words[1]}
)";

constexpr std::string_view kEnd = R"(
  if [[ $current == -* && -z $values ]]; then
    values=$options
  elif [[ -z $values ]]; then
    values=$argument
  fi
  # The word as the shell would pass it, without quotes.
  current=${current#[\"\']}
  current=${current//\\/}
  case $values in
    BACKEND)
      if [[ $current == plugin:* ]]; then
        while IFS= read -r reply; do replies+=("plugin:$reply"); done \
          < <(compgen -f -- "${current#plugin:}")
      else
        _rastercheck_backends "$program"
      fi
      compopt -o filenames 2>/dev/null
      ;;
    PROPERTY) _rastercheck_properties "$program"; compopt -o filenames 2>/dev/null ;;
    FILE) while IFS= read -r reply; do replies+=("$reply"); done < <(compgen -f -- "$current")
      compopt -o filenames 2>/dev/null ;;
    DIR) while IFS= read -r reply; do replies+=("$reply"); done < <(compgen -d -- "$current")
      compopt -o filenames 2>/dev/null ;;
    *) read -r -a replies <<<"${values#LIST }" ;;
  esac
  if [[ $values == LIST\ * && $current == *,* ]]; then
    replies=("${replies[@]/#/${current%,*},}")
  fi
  prefix=
  [[ $current == *[:=]* ]] && prefix=${current%"${current##*[:=]}"}
  for reply in "${replies[@]}"; do
    [[ $reply == "$current"* ]] && COMPREPLY+=("${reply#"$prefix"}")
  done
  [[ ${COMPREPLY[*]} == *: ]] && compopt -o nospace 2>/dev/null
  return 0
}
complete -F _rastercheck rastercheck
)";

/// Returns the key by which the script looks up an option's values: a type that it completes, or
/// the values themselves. "LIST" precedes them if the option takes several, with commas between.
std::string values_of(const CLI::Option& option) {
  if (const auto choices = choices_of(option); !choices.empty()) {
    return fmt::format("{}{}", option.get_delimiter() == ',' ? "LIST " : "",
                       fmt::join(choices, " "));
  }
  const std::string type = type_of(option);
  const bool is_known = type == kBackend || type == kProperty || type == kFile || type == kFolder;
  return is_known ? type : "";
}

/// Returns "corpus add": the command's full name without the program's.
std::string name_within(const CLI::App& program, const CLI::App& command) {
  return full_name(command).substr(program.get_name().size() + 1);
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// Returns the words that may follow a command: its options, and its commands or first argument.
std::string words_behind(const CLI::App& app) {
  std::vector<std::string> options;
  for (const CLI::Option* option : options_of(app)) {
    for (std::string& name : names_of(*option)) options.push_back(std::move(name));
  }
  std::vector<std::string> commands;
  for (const CLI::App* command : shown_commands(app)) commands.push_back(command->get_name());
  const auto arguments = arguments_of(app);
  const std::string argument = arguments.empty() ? fmt::format("{}", fmt::join(commands, " "))
                                                 : values_of(*arguments.front());
  return fmt::format("options='{}' argument='{}'", fmt::join(options, " "), argument);
}

/// Returns the script's lines for options that take a value, one line per command and option.
std::string values_behind(const CLI::App& program, const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : options_of(command)) {
    if (type_of(*option).empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : names_of(*option)) {
      patterns.push_back(fmt::format("'{} {}'", name_within(program, command), name));
    }
    // If the values are unknown, nothing is completed, not even an option.
    const std::string values = values_of(*option);
    text += fmt::format("    {}) values='{}' ;;\n", fmt::join(patterns, " | "),
                        values.empty() ? " " : values);
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::vector<const CLI::App*> commands;
  std::string groups;
  for (const CLI::App* command : shown_commands(program)) {
    commands.push_back(command);
    const auto inner = shown_commands(*command);
    commands.insert(commands.end(), inner.begin(), inner.end());
    if (!inner.empty()) groups += (groups.empty() ? "" : " | ") + command->get_name();
  }
  std::string behind = fmt::format("    '') {} ;;\n", words_behind(program));
  std::string values;
  for (const CLI::App* command : commands) {
    behind +=
        fmt::format("    '{}') {} ;;\n", name_within(program, *command), words_behind(*command));
    values += values_behind(program, *command);
  }
  std::string text(kBegin);
  text += fmt::format(
      "  case $command in\n    {}) ((${{#words[@]}} > 3)) && command+=\" ${{words[2]}}\" ;;\n  "
      "esac\n",
      groups);
  text += "  case $command in\n" + behind + "    *) options= argument= ;;\n  esac\n";
  text += "  values=\n  case \"$command $previous\" in\n" + values + "  esac";
  return text + std::string(kEnd);
}

}  // namespace rastercheck::cli
