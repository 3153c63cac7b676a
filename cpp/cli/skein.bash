# Bash completion for skein; installed to share/bash-completion/completions. From a build tree: `source cpp/cli/skein.bash`.
# Words come from the help of skein itself, so there is nothing to keep up to date here.

# The names that `skein WORDS --help` lists under a heading.
_skein_listed() {
  local heading=$1
  shift
  "$@" --help 2>/dev/null | sed -n "/^$heading/,/^\$/p" | sed -nE 's/^  ((-[[:alnum:]], ?|-[[:alnum:]],)?(--)?[a-z][a-z-]*).*/\1/p' |
    sed -E 's/^-.,//'
}

_skein() {
  local current=${COMP_WORDS[COMP_CWORD]} word
  local -a words=("${COMP_WORDS[0]}")
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word =~ ^[a-z]+$ ]] && _skein_listed Subcommands "${words[@]}" | grep -qx -- "$word" && words+=("$word")
  done
  case $current in
    -*) mapfile -t COMPREPLY < <(compgen -W "$(_skein_listed Options "${words[@]}" | grep -e '^--')" -- "$current") ;;
    *)
      mapfile -t COMPREPLY < <(compgen -W "$(_skein_listed Subcommands "${words[@]}")" -- "$current")
      case "${words[*]:1}" in
        'path upload' | 'formation apply' | 'log '?*) mapfile -t COMPREPLY < <(compgen -f -- "$current") ;;
      esac
      ;;
  esac
}
complete -o filenames -F _skein skein
