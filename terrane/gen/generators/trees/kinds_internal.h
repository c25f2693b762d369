// One function for each kind draws a shape of it. The seed of `random` selects the variant. trees.cpp uses
// it.
#pragma once

#include "terrane/gen/generators/trees/canvas.h"

namespace terrane::gen::trees {

void drawOak(Canvas& canvas, Random& random);
void drawOldOak(Canvas& canvas, Random& random);
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

}  // namespace terrane::gen::trees
