/** HTTP requests to web-bridge: what is too large or too slow for the live link. */

/** Why a request got no result, for people. */
export class ApiError extends Error {}

export class Api {
  /** `base` is the page's own address. */
  constructor(private readonly base: string) {}

  /** Throws ApiError; an aborted request throws the abort's reason. */
  async getJson<T>(path: string, abort?: AbortSignal): Promise<T> {
    return (await this.fetch(path, { signal: abort ?? null })).json() as Promise<T>;
  }

  async getBytes(path: string, abort?: AbortSignal): Promise<ArrayBuffer> {
    return (await this.fetch(path, { signal: abort ?? null })).arrayBuffer();
  }

  async postJson<T>(path: string, body: unknown, abort?: AbortSignal): Promise<T> {
    const response = await this.fetch(path, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(body),
      signal: abort ?? null,
    });
    return response.json() as Promise<T>;
  }

  async delete<T>(path: string, headers: Record<string, string>): Promise<T> {
    return (await this.fetch(path, { method: "DELETE", headers })).json() as Promise<T>;
  }

  private async fetch(path: string, options: RequestInit): Promise<Response> {
    let response: Response;
    try {
      response = await fetch(new URL(path, this.base), options);
    } catch (error) {
      if (options.signal?.aborted) throw error;
      throw new ApiError("web-bridge can't be reached.");
    }
    if (!response.ok) throw new ApiError(await reasonOf(response));
    return response;
  }
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
