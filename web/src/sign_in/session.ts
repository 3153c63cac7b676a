/** Who this browser is to a bridge that demands tokens. */
import { signal } from "@preact/signals";
import { ApiError, type Api } from "../link/api";

/** As GET /api/session tells it. */
export interface Who {
  /** False: this bridge demands no tokens. */
  signed_in: boolean;
  /** Whose token it is. */
  name: string;
  role: "operator" | "viewer";
}

export type SessionState =
  | { kind: "unknown" }
  /** The bridge wants a token first. */
  | { kind: "asked" }
  | { kind: "known"; who: Who };

const kPath = "api/session";
const kUnauthorized = 401;

export class Session {
  readonly state = signal<SessionState>({ kind: "unknown" });

  /** `onAsked` and `onKnown` are told whenever a bridge has said so. */
  constructor(
    private readonly api: Pick<Api, "getJson" | "postJson" | "delete">,
    private readonly onAsked: () => void,
    private readonly onKnown: () => void,
  ) {}

  /** Asks the bridge; what can't be asked stays as it was. */
  async check(): Promise<void> {
    try {
      this.state.value = { kind: "known", who: await this.api.getJson<Who>(kPath) };
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== kUnauthorized) return;
      this.state.value = { kind: "asked" };
      this.onAsked();
    }
  }

  /** @returns why not, for people; "" when signed in. */
  async signIn(token: string): Promise<string> {
    try {
      this.state.value = { kind: "known", who: await this.api.postJson<Who>(kPath, { token }) };
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
    this.onKnown();
    return "";
  }

  /** @returns why not, for people; "" when signed out. */
  async signOut(): Promise<string> {
    try {
      await this.api.delete(kPath, {});
      return "";
    } catch (error) {
      return error instanceof Error ? error.message : String(error);
    }
  }
}
