// One function for each kind draws a shape of it. The seed of `random` selects the variant. trees.cpp uses
// it.
#pragma once

#include "terrane/gen/generators/trees/canvas.h"

namespace terrane::gen::trees {

void drawOak(Canvas& canvas, Random& random);
void drawOldOak(Canvas& canvas, Random& random);
void drawGiantTree(Canvas& canvas, Random& random);
void drawBirch(Canvas& canvas, Random& random);
void drawWillow(Canvas& canvas, Random& random);
void drawDeadTree(Canvas& canvas, Random& random);
void drawBush(Canvas& canvas, Random& random);

void drawAcacia(Canvas& canvas, Random& random);
void drawBaobab(Canvas& canvas, Random& random);
void drawPalm(Canvas& canvas, Random& random);

void drawSpruce(Canvas& canvas, Random& random);
void drawPine(Canvas& canvas, Random& random);
void drawLarch(Canvas& canvas, Random& random);
void drawCypress(Canvas& canvas, Random& random);

void drawBoulder(Canvas& canvas, Random& random);
void drawFallenLog(Canvas& canvas, Random& random);
void drawGiantMushroom(Canvas& canvas, Random& random);

void drawBeech(Canvas& canvas, Random& random);
void drawMaple(Canvas& canvas, Random& random);
void drawAspen(Canvas& canvas, Random& random);
void drawPoplar(Canvas& canvas, Random& random);
void drawCherry(Canvas& canvas, Random& random);
void drawHazel(Canvas& canvas, Random& random);
void drawYoungOak(Canvas& canvas, Random& random);
void drawYoungBirch(Canvas& canvas, Random& random);

void drawFir(Canvas& canvas, Random& random);
void drawYoungFir(Canvas& canvas, Random& random);
void drawYoungSpruce(Canvas& canvas, Random& random);
void drawSequoia(Canvas& canvas, Random& random);
void drawCedar(Canvas& canvas, Random& random);
void drawStonePine(Canvas& canvas, Random& random);
void drawKrummholz(Canvas& canvas, Random& random);
void drawJuniper(Canvas& canvas, Random& random);

void drawOlive(Canvas& canvas, Random& random);
void drawEucalyptus(Canvas& canvas, Random& random);
void drawJoshuaTree(Canvas& canvas, Random& random);
void drawDryShrub(Canvas& canvas, Random& random);

void drawKapok(Canvas& canvas, Random& random);
void drawFig(Canvas& canvas, Random& random);
void drawMangrove(Canvas& canvas, Random& random);
void drawTreeFern(Canvas& canvas, Random& random);
void drawDwarfPalm(Canvas& canvas, Random& random);
void drawBamboo(Canvas& canvas, Random& random);
void drawThicket(Canvas& canvas, Random& random);

void drawSnag(Canvas& canvas, Random& random);
void drawStump(Canvas& canvas, Random& random);
void drawUprootedTree(Canvas& canvas, Random& random);

}  // namespace terrane::gen::trees
