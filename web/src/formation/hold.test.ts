import { expect, test } from "vitest";
import { Commands } from "../link/commands";
import type { Formation } from "../link/messages";
import { bodyOf, newDraft } from "./draft";
import { command, concerned } from "./hold";

const formation = (id: number, hold: boolean): Formation => ({
  type: "formation",
  utime: 1,
  ...bodyOf({ ...newDraft(id, [id]), name: id === 2 ? "" : `F${id}` }, hold),
});

interface Sent {
  id: string;
  body: { action: string; formation: { formation_id: number } };
}

/** A station that refuses formation 2, and never lets more than 16 wait. */
function station() {
  const waiting: Sent[] = [];
  let most = 0;
  const commands = new Commands((text) => {
    waiting.push(JSON.parse(text) as Sent);
    most = Math.max(most, waiting.length);
    queueMicrotask(() => {
      const sent = waiting.shift();
      if (sent === undefined) return;
      const accepted = sent.body.formation.formation_id !== 2;
      const reason = accepted ? "" : "no circle fits";
      commands.acknowledged({ type: "ack", id: sent.id, channel: "CMD_FORMATION", accepted, reason });
    });
    return true;
  });
  return { commands, most: () => most };
}

test("hold concerns those that fly on, resume those that hold", () => {
  const all = new Map([3, 1, 2].map((id) => [id, formation(id, id === 2)]));
  expect(concerned(all, "hold").map(({ formation_id }) => formation_id)).toEqual([1, 3]);
  expect(concerned(all, "resume").map(({ formation_id }) => formation_id)).toEqual([2]);
});

test("a refusal says whose it is, and the others are commanded all the same", async () => {
  const { commands } = station();
  const three = [1, 2, 3].map((id) => formation(id, false));
  const outcome = await command(commands, "hold", three);
  expect(outcome).toEqual({ accepted: false, reason: "Formation 2: no circle fits" });
});

test("a hundred formations are commanded a few at a time", async () => {
  const { commands, most } = station();
  const many = Array.from({ length: 100 }, (_, i) => formation(i + 10, false));
  expect(await command(commands, "hold", many)).toEqual({ accepted: true, reason: "" });
  expect(most()).toBeLessThanOrEqual(16);
});
