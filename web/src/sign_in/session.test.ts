import { expect, test } from "vitest";
import { ApiError } from "../link/api";
import { Session, type Who } from "./session";

const kAda: Who = { signed_in: true, name: "Ada", role: "operator" };

/** A bridge that answers as it is told, and notes what was asked of it. */
class Bridge {
  answer: Who | Error = kAda;
  asked: string[] = [];
  told: string[] = [];
  readonly session = new Session(
    {
      getJson: <T>(path: string) => this.reply<T>(`GET ${path}`),
      postJson: <T>(path: string, body: unknown) => this.reply<T>(`POST ${path} ${JSON.stringify(body)}`),
      delete: <T>(path: string) => this.reply<T>(`DELETE ${path}`),
    },
    () => this.told.push("asked"),
    () => this.told.push("known"),
  );
  private reply<T>(request: string): Promise<T> {
    this.asked.push(request);
    return this.answer instanceof Error ? Promise.reject(this.answer) : Promise.resolve(this.answer as T);
  }
}

test("a bridge that demands no token is known by its answer, and nothing is asked of the person", async () => {
  const bridge = new Bridge();
  bridge.answer = { signed_in: false, name: "", role: "operator" };
  await bridge.session.check();
  expect(bridge.session.state.value).toEqual({ kind: "known", who: bridge.answer });
  expect(bridge.told).toEqual([]);
});

test("a bridge that demands one asks for it, and a bridge that isn't there says nothing of it", async () => {
  const bridge = new Bridge();
  bridge.answer = new ApiError("web-bridge can't be reached.");
  await bridge.session.check();
  expect(bridge.session.state.value).toEqual({ kind: "unknown" });
  bridge.answer = new ApiError("sign in first", 401);
  await bridge.session.check();
  expect(bridge.session.state.value).toEqual({ kind: "asked" });
  expect(bridge.told).toEqual(["asked"]);
});

test("a token that opens nothing is told of, and one that does signs in", async () => {
  const bridge = new Bridge();
  bridge.answer = new ApiError("this token opens nothing here", 401);
  expect(await bridge.session.signIn("x")).toBe("this token opens nothing here");
  expect(bridge.told).toEqual([]);
  bridge.answer = kAda;
  expect(await bridge.session.signIn("skein_y")).toBe("");
  expect(bridge.asked.at(-1)).toBe('POST api/session {"token":"skein_y"}');
  expect(bridge.session.state.value).toEqual({ kind: "known", who: kAda });
  expect(bridge.told).toEqual(["known"]);
});
