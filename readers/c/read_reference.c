/* Print case, quantity and value of a CSV file of reference values: cc -o read_reference read_reference.c -lm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COLUMNS 12

int main(int argc, char **argv)
{
    char line[4096], *cell[COLUMNS], *end;
    unsigned long a, b;
    long k = 0, row = 0, rows = -1;
    FILE *file = argc > 1 ? fopen(argv[1], "r") : NULL;
    if (!file || !fgets(line, sizeof line, file)) {
        fprintf(stderr, "read_reference: cannot read %s\n", argc > 1 ? argv[1] : "(no file named)");
        return 1;
    }
    while (fgets(line, sizeof line, file)) {
        int columns = 0;
        line[strcspn(line, "\r\n")] = '\0';
        a = 1, b = 0, end = strrchr(line, ','); /* Adler-32 of what is before the last comma */
        for (char *p = line; end && p < end; p++) a = (a + (unsigned char)*p) % 65521, b = (b + a) % 65521;
        for (char *p = line; p; p = strchr(p, ',') ? (end = strchr(p, ','), *end = '\0', end + 1) : NULL)
            if (columns++ < COLUMNS) cell[columns - 1] = p;
        if (columns != COLUMNS || strlen(cell[10]) != 64 || strlen(cell[11]) != 8 || sscanf(cell[0], "%ld/%ld", &row, &rows) != 2 || row != ++k) {
            fprintf(stderr, "read_reference: %s: row %ld is damaged\n", argv[1], k);
            return 1;
        }
        double value = strtod(cell[3], &end);
        if (*end || end == cell[3] || !isfinite(value)) {
            fprintf(stderr, "read_reference: %s: row %ld: %.40s is no finite number\n", argv[1], k, cell[3]);
            return 1;
        }
        if (strtoul(cell[11], &end, 16) != (b << 16 | a) || *end) {
            fprintf(stderr, "read_reference: %s: row %ld has the wrong checksum\n", argv[1], k);
            return 1;
        }
        printf("%s,%s,%.17g\n", cell[1], cell[2], value);
    }
    if (k != rows) {
        fprintf(stderr, "read_reference: %s: %ld rows, %ld are announced\n", argv[1], k, rows);
        return 1;
    }
    return 0;
}
