// The page's side of the worker.
import {LaminaError} from "./error.ts";
import type {Download, MadeMesh, Offer, ReplyMessage, Request} from "./messages.ts";

interface Waiting {
  resolve(value: Offer | MadeMesh | Download): void;
  reject(error: Error): void;
  progress?: (stage: string) => void;
}

/** A request was given up because stop() was called. */
export class Stopped extends Error {}

/** A worker that makes meshes. */
export class Mesher {
  #worker = this.#start();
  #waiting = new Map<number, Waiting>();
  #requests = 0;

  begin(): Promise<Offer> {
    return this.#ask({kind: "begin"}) as Promise<Offer>;
  }

  mesh(request: Omit<Request & {kind: "mesh"}, "kind">, progress: (stage: string) => void): Promise<MadeMesh> {
    return this.#ask({kind: "mesh", ...request}, progress) as Promise<MadeMesh>;
  }

  write(name: string, format: string): Promise<Download> {
    return this.#ask({kind: "write", name, format}) as Promise<Download>;
  }

  /** Ends the work at once; the next request starts a new worker. */
  stop(): void {
    this.#worker.terminate();
    this.#fail(new Stopped("stopped"));
    this.#worker = this.#start();
  }

  #start(): Worker {
    const worker = new Worker(new URL("worker.js", import.meta.url), {type: "module"});
    worker.onmessage = ({data}: MessageEvent<ReplyMessage>) => {
      const waiting = this.#waiting.get(data.number);
      if (!waiting) return;
      if ("stage" in data) return waiting.progress?.(data.stage);
      this.#waiting.delete(data.number);
      if ("error" in data) waiting.reject(new LaminaError(data.error));
      else waiting.resolve(data.value);
    };
    worker.onerror = (event) => this.#fail(new Error(event.message || "the worker could not be started"));
    return worker;
  }

  #fail(error: Error): void {
    for (const {reject} of this.#waiting.values()) reject(error);
    this.#waiting.clear();
  }

  #ask(request: Request, progress?: (stage: string) => void): Promise<Offer | MadeMesh | Download> {
    const number = ++this.#requests;
    return new Promise((resolve, reject) => {
      this.#waiting.set(number, {resolve, reject, progress});
      this.#worker.postMessage({...request, number});
    });
  }
}
