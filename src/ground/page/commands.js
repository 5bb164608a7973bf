// Commands to the program, at a port of their own: streams may hold all connections of the page's.
const Commands = (() => {
  const port = document.querySelector('meta[name="command-port"]').content;
  const stopPort = document.querySelector('meta[name="stop-port"]').content;
  const place = (at, path) => `${location.protocol}//${location.hostname}:${at}/${path}`;
  let token = "", client = "", number = 0, took_ms = null;

  async function post(command, to = place(port, "command")) {
    const asked = performance.now();
    // A stop is sent to its end also when the page is closed meanwhile.
    const answer = await fetch(to, { keepalive: command.do === "hover" || command.do === "abort",
      method: "POST", cache: "no-store", signal: AbortSignal.timeout(5000),
      headers: { Authorization: "Bearer " + token, "Content-Type": "application/json" },
      body: JSON.stringify(command),
    });
    const reply = await answer.json();
    took_ms = performance.now() - asked;
    return { ...reply, status: answer.status, took_ms };
  }
  async function join() {
    const reply = await post({ do: "join" });
    if (!reply.client) throw new Error(reply.words);
    client = reply.client;
    number = 0;
  }
  // An abort goes both ways, and the first answer counts: the stop has a port of its own.
  function abort() {
    const ways = [post({ do: "abort" }, place(stopPort, "stop")), post({ do: "abort" })];
    return Promise.any(ways).catch(error => { throw error.errors[0]; });
  }
  // A command of this page, numbered so that none counts twice.
  async function give(word, more = {}) {
    if (word === "abort") return abort();
    if (word === "hover") return post({ do: word });
    if (!client) await join();
    let reply = await post({ do: word, client, number: ++number, ...more });
    if (reply.status === 410) {  // the program was started anew, or has forgotten this page
      await join();
      reply = await post({ do: word, client, number: ++number, ...more });
    }
    return reply;
  }
  return {
    give,
    enter(nextToken) { token = nextToken; client = ""; },
    client: () => client,
    took_ms: () => took_ms,  // the last command and its answer
  };
})();
