/* The page in Firefox. */
import { open_in_firefox } from "./firefox.mjs";
import { drag_brake_in_firefox, SIZES } from "./still.mjs";
import { check, test, url } from "./suite.mjs";
import { crawled, IDLE } from "./visit.mjs";

export async function test_firefox() {
    const page = await open_in_firefox(url);
    try {
        await test("Firefox: the page solves, says so and draws", async () => {
            await page.until(IDLE);
            check(
                /^Half of this contact/.test(await page.run("document.getElementById('headline').textContent")),
                "the headline",
            );
            check(
                await page.run(
                    "(() => { const c = document.querySelector('canvas.stage'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; return new Set(d.filter((v, k) => k % 4 === 0)).size > 20; })()",
                ),
                "an empty stage",
            );
        });
        await crawled("Firefox", page);
    } finally {
        await page.close();
    }
    await test("Firefox: nothing moves under a finger", async () => {
        const { moved, headlines, faults } = await drag_brake_in_firefox(url, "touch", ...SIZES[1]);
        check(moved < 1 && headlines > 3 && !faults.length, JSON.stringify({ moved, headlines, faults }));
    });
}
