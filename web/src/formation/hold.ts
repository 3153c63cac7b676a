/** Hold and Resume: formations loiter where they are, and go on. What holds is told by FORMATION, never by what was pressed. */
import type { Commands, Outcome } from "../link/commands";
import type { Formation } from "../link/messages";

/** The bridge lets one browser wait for 16 answers at a time. */
const kAtOnce = 8;

export function nameOf(formation: Pick<Formation, "formation_id" | "name">): string {
  return formation.name === "" ? `Formation ${formation.formation_id}` : formation.name;
}

/** Those that the action would change, by id. */
export function concerned(
  formations: ReadonlyMap<number, Formation>,
  action: "hold" | "resume",
): readonly Formation[] {
  return [...formations.values()]
    .filter((formation) => formation.hold === (action === "resume"))
    .sort((a, b) => a.formation_id - b.formation_id);
}

/** Commands all of them; a refusal says whose it is. */
export async function command(
  commands: Commands,
  action: "hold" | "resume",
  formations: readonly Formation[],
): Promise<Outcome> {
  const refusals: string[] = [];
  for (let i = 0; i < formations.length; i += kAtOnce) {
    const some = formations.slice(i, i + kAtOnce);
    const outcomes = await Promise.all(
      some.map(({ formation_id }) =>
        commands.request("CMD_FORMATION", { action, formation: { formation_id } }),
      ),
    );
    outcomes.forEach(({ accepted, reason }, j) => {
      if (!accepted) refusals.push(`${nameOf(some[j])}: ${reason}`);
    });
  }
  return { accepted: refusals.length === 0, reason: refusals.join(" ") };
}
