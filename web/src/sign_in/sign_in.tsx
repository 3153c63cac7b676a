import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Session } from "./session";
import "./sign_in.css";

/** In the middle of the page while the bridge wants to know who this is. */
export function SignIn({ session }: { session: Session }) {
  const problem = useSignal("");
  const busy = useSignal(false);
  const field = useRef<HTMLInputElement>(null);
  useLayoutEffect(() => field.current?.focus(), []);
  const signIn = async () => {
    busy.value = true;
    problem.value = await session.signIn(field.current?.value.trim() ?? "");
    busy.value = false;
    if (problem.value !== "") field.current?.select();
  };
  return (
    <section class="panel sign-in" aria-labelledby="sign-in-title">
      <h2 id="sign-in-title">Sign in</h2>
      <p>
        This ground station lets in who has a token. An operator's may command the fleet, a viewer's may look.
      </p>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          if (!busy.value) void signIn();
        }}
      >
        <label for="sign-in-token">Token</label>
        <input
          id="sign-in-token"
          ref={field}
          type="password"
          autocomplete="current-password"
          spellcheck={false}
          required
          aria-invalid={problem.value !== ""}
          aria-describedby="sign-in-problem"
        />
        <button type="submit" class="button primary" aria-disabled={busy.value}>
          Sign in
        </button>
      </form>
      <p id="sign-in-problem" class="wrong-token" role="alert">
        {problem.value}
      </p>
      <p class="hint">
        Whoever runs the ground station makes one: <code>skein token new NAME --role operator</code>
      </p>
    </section>
  );
}

/** In the settings, of who is signed in. */
export function SignedIn({ session }: { session: Session }) {
  const problem = useSignal("");
  const state = session.state.value;
  if (state.kind !== "known" || !state.who.signed_in) return null;
  const signOut = async () => {
    problem.value = await session.signOut();
    if (problem.value === "") location.reload();
  };
  return (
    <>
      <h2>Signed in</h2>
      <p class="signed-in">
        <span>
          {state.who.name}, {state.who.role}
        </span>
        <button type="button" class="button quiet" onClick={() => void signOut()}>
          Sign out
        </button>
      </p>
      {problem.value !== "" && (
        <p class="wrong-token" role="alert">
          {problem.value}
        </p>
      )}
    </>
  );
}
