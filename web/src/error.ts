import type {Failure} from "./values.ts";

/** An error of lamina. `kind` says what is at fault, `file`, `line`, `option` and `at` where, if it is known. */
export class LaminaError extends Error {
  readonly kind: Failure["kind"];
  readonly file?: string;
  readonly line?: number;
  readonly option?: string;
  readonly at?: [number, number] | null;

  constructor(failure: Failure) {
    super(failure.message);
    this.name = "LaminaError";
    this.kind = failure.kind;
    this.file = failure.file;
    this.line = failure.line;
    this.option = failure.option;
    this.at = failure.at;
  }
}
