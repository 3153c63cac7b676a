/** HTTP requests to web-bridge: what is too large or too slow for the live link. */

/** Why a request got no result, for people. */
export class ApiError extends Error {
  /** `status` is that of the answer, 0 when there was none. */
  constructor(
    message: string,
    readonly status = 0,
  ) {
    super(message);
  }
}

export class Api {
  /** `base` is the page's own address. */
  constructor(private readonly base: string) {}

  /** Throws ApiError; an aborted request throws the abort's reason. */
  async getJson<T>(path: string, abort?: AbortSignal): Promise<T> {
    return this.fetch(path, { signal: abort ?? null }, json<T>);
  }

  async getBytes(path: string, abort?: AbortSignal): Promise<ArrayBuffer> {
    return this.fetch(path, { signal: abort ?? null }, (response) => response.arrayBuffer());
  }

  async postJson<T>(path: string, body: unknown, abort?: AbortSignal): Promise<T> {
    const options = {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(body),
      signal: abort ?? null,
    };
    return this.fetch(path, options, json<T>);
  }

  async delete<T>(path: string, headers: Record<string, string>): Promise<T> {
    return this.fetch(path, { method: "DELETE", headers }, json<T>);
  }

  /** `read` is part of it: a bridge may end in the midst of its answer. */
  private async fetch<T>(
    path: string,
    options: RequestInit,
    read: (response: Response) => Promise<T>,
  ): Promise<T> {
    try {
      const response = await fetch(new URL(path, this.base), options);
      if (!response.ok) throw new ApiError(await reasonOf(response), response.status);
      return await read(response);
    } catch (error) {
      if (error instanceof ApiError || options.signal?.aborted) throw error;
      throw new ApiError("web-bridge can't be reached.");
    }
  }
}

function json<T>(response: Response): Promise<T> {
  return response.json() as Promise<T>;
}

/** The bridge tells why in JSON with a `reason`, or in a plain sentence. */
async function reasonOf(response: Response): Promise<string> {
  const text = (await response.text()).trim();
  try {
    const { reason } = JSON.parse(text) as { reason?: unknown };
    if (typeof reason === "string" && reason !== "") return reason;
  } catch {
    if (text !== "" && text.length < 300) return text;
  }
  return `web-bridge answered ${response.status}.`;
}
