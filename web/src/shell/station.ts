/** What every panel is given. */
import type { Signal } from "@preact/signals";
import type { Control } from "../control/control";
import type { Api } from "../link/api";
import type { Commands } from "../link/commands";
import type { MapAccess } from "../map/map_access";
import type { PayloadRequests } from "../payload/payload_requests";
import type { Session } from "../sign_in/session";
import type { Player } from "../timeline/player";
import type { Store } from "../state/store";

export interface Station {
  readonly store: Store;
  readonly commands: Commands;
  /** Who may command, and this page's part in it. */
  readonly control: Control;
  readonly api: Api;
  /** Who this browser is to a bridge that demands tokens. */
  readonly session: Session;
  readonly payloads: PayloadRequests;
  /** The recording that is open, if one is. */
  readonly player: Player;
  /** Null until the map is there. */
  readonly map: Signal<MapAccess | null>;
  /** Tries to connect at once. */
  readonly retry: () => void;
}
