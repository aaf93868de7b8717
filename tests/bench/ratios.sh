# shellcheck shell=bash
# For tests/bench: whether the ratios of the rounds meet their goal.

# judge_ratios KEY WHAT SENSE GOAL < ratios, one a line: a row of the table, or with $json a member
# of an object. SENSE: ">" or "<". Of three rounds and more the worst one does not count.
judge_ratios() {
  sort -g | awk -v key="$1" -v what="$2" -v sense="$3" -v goal="$4" -v json="${json:-}" '
    { value[NR] = $1 }
    END {
      drop = NR >= 3 ? 1 : 0
      worst = sense == ">" ? value[1 + drop] : value[NR - drop]
      met = sense == ">" ? worst >= goal : worst <= goal
      median = value[int((NR + 1) / 2)]
      if (json)
        printf "\"%s\": {\"median\": %.3f, \"least\": %.3f, \"most\": %.3f, \"goal\": %g, " \
          "\"met\": %s}", key, median, value[1], value[NR], goal, met ? "true" : "false"
      else
        printf "%-58s %8.2f %8.2f %8.2f   %s %-5g %s\n", what, median, value[1], value[NR], sense,
          goal, met ? "met" : "NOT MET"
      exit !met
    }'
}
